"""Give the built package its long description: README.md with links that hold outside of a checkout.

All else stands in pyproject.toml. An index of packages shows the README alone, without the files that it links to. If
the project has a URL named `Repository`, relative links lead there. Otherwise the words of a link remain, and a picture
becomes its description.
"""

import re
import tomllib
from pathlib import Path

from setuptools import setup

HERE = Path(__file__).parent
FENCED = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"(!?)\[((?:!\[[^\]]*\]\([^)]*\)|[^\[\]])*)\]\((?!https?:|mailto:|#)([^)\s]+)\)")


def published(text: str, repository: str | None) -> str:
    """Return a Markdown text whose relative links lead to a repository, or are plain words where there is none."""

    def absolute(link: re.Match[str]) -> str:
        picture, words, target = link.groups()
        words = LINK.sub(absolute, words)
        if repository is not None:
            return f"{picture}[{words}]({repository.rstrip('/')}/{'raw' if picture else 'blob'}/HEAD/{target})"
        return f"*Picture `{target}` of the source distribution: {words}*" if picture else words

    return "".join(each if each.startswith("```") else LINK.sub(absolute, each) for each in FENCED.split(text))


if __name__ == "__main__":
    project = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    setup(
        long_description=published((HERE / "README.md").read_text(encoding="utf-8"), project["urls"].get("Repository")),
        long_description_content_type="text/markdown",
    )
