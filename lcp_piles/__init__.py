from .piles import *
from .system import contact_system
from .contact_lcp import contact_lcp
from .lemke import lemke
from .solve import solve
from .verify import verify
