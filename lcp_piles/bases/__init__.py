"""LCPs by their complementary bases: proposed in floats, proved exactly or within bounds."""
