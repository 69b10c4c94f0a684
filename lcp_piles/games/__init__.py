"""Games of two players in normal form: equilibria, exactly."""
