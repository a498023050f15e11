"""What the advisor says."""

from __future__ import annotations

from html import escape
from typing import NamedTuple


class Advice(NamedTuple):
    """What the advisor says before a run.

    Attributes
    ----------
    verdict : str
        ``fine``, ``note``, ``warning`` or, where the scenario says so in ``[allow]``, ``allowed``.
    contact : str
        Name of the contact it is about.
    text : str
        What it means and, unless it is fine, what to do.
    code : str
        ``W002``; ``percuss explain W002`` explains it.
    reason : str or None
        Why it is allowed, where it is.

    Examples
    --------
    >>> first = percuss.check("plank.toml")[0]
    >>> first.verdict, first.code, first.text
    ('fine', 'W001', 'first contact at 10 ms of 150 ms')
    """

    verdict: str
    contact: str
    text: str
    code: str
    reason: str | None


class Review(list[Advice]):
    """Results of the model checks before a run: a list of :class:`Advice` that prints as lines and, in a notebook, as a table.

    Examples
    --------
    >>> percuss.check("plank.toml")
    fine: first contact at 10 ms of 150 ms [W001]
    fine: the contact lasts about 43.1 ms, 216 steps [W002]
    ...
    """

    @property
    def warnings(self) -> list[Advice]:
        """What deserves attention: notes and allowed ones are left out.

        Returns
        -------
        list of Advice
            Those whose verdict is ``warning``.

        Examples
        --------
        >>> percuss.check("plank.toml").warnings
        []
        >>> [one.code for one in percuss.check("plank.toml", time__step="50 ms").warnings]
        ['W002']
        """
        return [one for one in self if one.verdict == "warning"]

    def __repr__(self) -> str:
        if not self:
            return "<percuss.Review: no errors or warnings>"
        lines = (f"{one.verdict}: {one.text}" + (f" [{one.code}]" if one.code and one.code not in one.text else "") for one in self)
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        if not self:
            return "<p>no errors or warnings</p>"
        cells = ((one.verdict, one.contact, one.text, one.code, one.reason or "") for one in self)
        rows = "".join("<tr>" + "".join(f"<td style='text-align:left'>{escape(text)}</td>" for text in row) + "</tr>" for row in cells)
        heads = "".join(f"<th>{name}</th>" for name in ("verdict", "about", "what it says", "code", "allowed because"))
        return f"<table><tr>{heads}</tr>{rows}</table>"
