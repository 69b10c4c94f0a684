"""The figures and the table of the paper, made again."""
