"""The mechanics of a scene as integers: contact systems, given contact sets, the LCP."""
