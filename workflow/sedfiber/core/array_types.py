"""Array aliases; the name says what the axes are.

Lengths are in bead radii ``a``, times in ``a/U_s``, forces in ``6πμaU_s``.
"""

from typing import Annotated, Any

from numpy.typing import NDArray

Array = NDArray[Any]  # float64, unless a docstring says otherwise
Positions = Annotated[Array, "(N, d): one row a bead, d = 2 in the plane and 3 in volume"]
Matrix = Annotated[Array, "(N d, N d): rows and columns ordered bead by bead"]
Band = Annotated[Array, "(5, d, d, N): [m, v, w, j] is the derivative of F_v on bead j + m − 2 by x_w of bead j"]
State = Annotated[Array, "(N d + 1,): flattened positions in the frame of the centre bead, then the work done"]
Times = Annotated[Array, "(T,)"]
History = Annotated[Array, "(T, N, 3)"]
