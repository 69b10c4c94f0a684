"""Discs of finite stiffness: the first order against the nonlinear pile and molecular dynamics."""
