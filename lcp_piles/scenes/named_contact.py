"""A contact by its name, as every output of the program prints it."""

from __future__ import annotations

from difflib import get_close_matches

from ..errors import InputError
from .names import contact_name
from .scene import Contact, Scene


def named_contact(scene: Scene, name: str) -> Contact:
    """The contact of this printed name, its ends in either order; `InputError` for none or several.

    >>> from lcp_piles import nt60
    >>> contact = named_contact(nt60(3), "(3,2)-floor")
    >>> contact == named_contact(nt60(3), "floor-(3,2)")
    True
    >>> contact.a, contact.b
    ((3, 2), 'floor')
    """
    plain = "".join(name.split()) if "(" in name else name
    found: list[Contact] = []
    names: list[str] = []
    for contact in scene.contacts:
        both = (contact_name((contact.a, contact.b)), contact_name((contact.b, contact.a)))
        names += both
        if name in both or plain in both:
            found.append(contact)
    if not found:
        close = get_close_matches(name, names, 3)
        remedy = f"close to it: {', '.join(close)}" if close else "`solve --out` lists them all"
        some = f", such as {names[0]}" if names else ", which has none"
        raise InputError("the contact", name, f"one of the scene{some}", remedy)
    if len(found) > 1:
        several = f"{len(found)} contacts have this name: give their discs other ids"
        raise InputError("the contact", name, "the name of one contact", several)
    return found[0]
