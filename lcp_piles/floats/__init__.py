"""Methods in floating point, which share nothing with the exact ones but the contact system."""
