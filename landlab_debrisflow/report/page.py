"""HTML of a report, from its content and the template beside this file."""

from functools import cache

import jinja2

from .content import Content


def render_page(content: Content) -> str:
    """Return the page of a report as HTML; texts are escaped.

    Parameters
    ----------
    content : Content

    Returns
    -------
    str
    """
    return _environment().get_template("report.html").render(content=content)


@cache
def _environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.PackageLoader(__package__), autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
