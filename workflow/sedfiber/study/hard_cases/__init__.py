"""Cases where programs of this kind usually fail, each with a reference."""
