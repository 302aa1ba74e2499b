"""What a user describes, and how it becomes a system of equations."""
