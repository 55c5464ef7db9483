"""The page in a browser, headless: it says nothing in the console, fits a phone and a screen, and prints."""

import html
import os
import re
import shutil
import subprocess

import pytest

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(BROWSER is None, reason="no Chromium in PATH (Debian: apt install chromium)"),
]

FRAME = """<!DOCTYPE html><title>frame</title><body>
<iframe style="width: {width}px; height: 900px; border: 0" srcdoc="{page}"></iframe>
<script>
addEventListener("load", () => {{
  const inner = document.querySelector("iframe").contentWindow, page = inner.document;
  const shown = [...page.images].filter((image) => !image.closest("details"));
  const lost = shown.filter((image) => image.naturalWidth === 0).length;
  document.body.dataset.probe = [inner.innerWidth, page.documentElement.scrollWidth, shown.length, lost].join(" ");
}});
</script></body>"""
"""A page in a frame of a width, which no window need have: windows are 500 pixels wide at least. Beside it are written
the width of the frame, that of the content, the number of pictures, and of pictures that cannot be shown."""


def browse(path, tmp_path, *options):
    """Run the browser on a page; return its standard output, and lines of the page's console."""
    home = tmp_path / "home"
    words = [
        BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
        "--disable-dev-shm-usage", "--enable-logging=stderr", f"--user-data-dir={home}", *options, path.as_uri(),
    ]  # fmt: skip
    done = subprocess.run(
        words, capture_output=True, text=True, timeout=120, check=True, env=os.environ | {"HOME": str(tmp_path)}
    )
    return done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line]


def probed(page, tmp_path, width):
    """Return the four numbers of `FRAME` for a page, and the lines of the console."""
    frame = tmp_path / "frame.html"
    text = html.escape(page.read_text(encoding="utf-8"))
    frame.write_text(FRAME.format(width=width, page=text), encoding="utf-8")
    out, console = browse(frame, tmp_path, "--window-size=1400,1000", "--dump-dom")
    return [int(one) for one in re.search(r'data-probe="([\d ]+)"', out)[1].split()], console


@pytest.mark.parametrize("width", [390, 1280])
def test_it_fits_and_shows_its_pictures(page, tmp_path, width):
    (frame, content, pictures, lost), console = probed(page, tmp_path, width)
    assert frame == width and content <= width
    assert pictures > 8 and lost == 0 and console == []


def test_the_page_itself_says_nothing_in_the_console(page, tmp_path):
    """With its own policy, under which a script or a picture from elsewhere would be told."""
    assert browse(page, tmp_path, "--dump-dom")[1] == []
    loading = tmp_path / "loading.html"
    text = page.read_text(encoding="utf-8")
    loading.write_text(text.replace("</main>", '<img src="x.png" alt="x"></main>'), encoding="utf-8")
    assert "Content Security Policy" in " ".join(browse(loading, tmp_path, "--dump-dom")[1])


def test_it_prints(page, tmp_path):
    path = tmp_path / "report.pdf"
    browse(page, tmp_path, "--no-pdf-header-footer", f"--print-to-pdf={path}")
    pages = re.findall(rb"/Type\s*/Page\b", path.read_bytes())
    assert 6 <= len(pages) <= 20  # some ten: two maps on a sheet, and the tables
