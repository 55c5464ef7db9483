"""Check a built site: ``python docs/_site/links.py docs/_build`` prints links that lead nowhere, and what is loaded."""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {"src", "srcset", "poster", "data"}


class Page(HTMLParser):
    """Identifiers and links of an HTML page."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[tuple[str, bool]] = []  # address, whether the browser loads it without being asked
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        """Keep identifiers, links, and addresses of what is loaded."""
        given = {name: value for name, value in attrs if value}
        self.ids.update(value for name, value in given.items() if name == "id" or (tag == "a" and name == "name"))
        for name, value in given.items():
            if name == "href" or name in LOADED:
                self.links.append((value, name in LOADED or tag == "link"))


def broken(site: Path) -> list[str]:
    """Return what is wrong with the links of a site, one sentence each.

    Parameters
    ----------
    site : Path
        Folder of the built site.

    Returns
    -------
    list of str
        Files and fragments that are missing, and resources loaded from another host.
    """
    pages = {path.resolve(): Page(path) for path in sorted(site.rglob("*.html"))}
    return [
        f"{path.relative_to(site.resolve()).as_posix()}: {address}: {problem}"
        for path, page in pages.items()
        for address, loaded in page.links
        if (problem := _problem(address, loaded, path, pages))
    ]


def count(site: Path) -> int:
    """Return the number of links of a site that lead to a file or a fragment of it."""
    return sum(not urlsplit(link).scheme for path in site.rglob("*.html") for link, _ in Page(path).links)


def _problem(address, loaded, path, pages):
    """Return what is wrong with an address on the page at `path`, or None."""
    parts = urlsplit(address)
    if parts.scheme or parts.netloc:
        return "is loaded from elsewhere" if loaded and parts.scheme != "data" else None
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not target.is_file():
        return "no such file"
    fragment = unquote(parts.fragment)
    return "no such anchor" if fragment and target in pages and fragment not in pages[target].ids else None


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    found = broken(folder)
    print(*found, f"{count(folder)} internal links, {len(found)} broken", sep="\n")
    sys.exit(bool(found))
