"""Training of autoencoders and neural ODEs."""
