"""Commands that the rules of the workflow call, one module each."""
