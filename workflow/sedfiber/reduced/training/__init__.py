"""How autoencoders and neural ODEs are trained."""
