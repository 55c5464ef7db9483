"""A page as a reader without a browser sees it: texts of elements, headings of sections, what it would load."""

from html.parser import HTMLParser

LOADING = {"src", "srcset", "href", "data", "poster", "action", "background", "xlink:href"}
VOID = {"meta", "img", "link", "br", "input", "hr"}


class Page(HTMLParser):
    """Elements of a page as (tag, attributes, text inside), in the order in which they begin."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.elements, self._open = [], []
        self.feed(text)
        self.close()
        assert not self._open, f"not closed: {[tag for tag, _ in self._open]}"

    def handle_starttag(self, tag, attributes):
        self.elements.append([tag, dict(attributes), ""])
        if tag not in VOID:
            self._open.append((tag, len(self.elements) - 1))

    def handle_endtag(self, tag):
        last, _ = self._open.pop()
        assert last == tag, f"</{tag}> closes <{last}>"

    def handle_data(self, data):
        for _, number in self._open:
            self.elements[number][2] += data

    def texts(self, tag):
        """Return the texts of all elements of a kind, spaces made plain."""
        return [" ".join(text.split()) for name, _, text in self.elements if name == tag]

    def loaded(self):
        """Return what the attributes of all elements name to be loaded or followed."""
        return [value for _, attributes, _ in self.elements for key, value in attributes.items() if key in LOADING]

    def table(self, caption):
        """Return the rows of a table as lists of cells, by its caption."""
        start = next(
            k for k, (tag, _, text) in enumerate(self.elements) if tag == "caption" and text.startswith(caption)
        )
        rows = []
        for tag, _, text in self.elements[start + 1 :]:
            if tag == "table":
                break
            if tag == "tr":
                rows.append([])
            elif tag in ("th", "td"):
                rows[-1].append(" ".join(text.split()))
        return rows


def read_page(path):
    """Return the page in a file."""
    return Page(path.read_text(encoding="utf-8"))
