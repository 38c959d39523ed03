# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of reports, read by a strict HTML5 parser, their pictures decoded.

Where a Chromium is installed they are opened in that, too (300 MB: tests/setup.sh does not ask for it).
"""

import base64
import re
import shutil
import subprocess
from pathlib import Path

import html5lib
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def parsed(path):
    parser = html5lib.HTMLParser(strict=True, namespaceHTMLElements=False)
    return parser.parse(Path(path).read_text(encoding="utf-8"))


def what_needs_other_files(path):
    """What of a page looks like a reference to another file."""
    text = re.sub(r'src="data:image/png;base64,[A-Za-z0-9+/=]*"', "", Path(path).read_text(encoding="utf-8"))
    return [word for word in ("http", "src=", "href=", "url(", "<script", "@import") if word in text]


def decoded(source):
    """Height by width by 3."""
    kind, text = source.split(",", 1)
    assert kind == "data:image/png;base64", kind
    data = base64.b64decode(text, validate=True)
    reader = vtkPNGReader()
    reader.SetMemoryBuffer(data)
    reader.SetMemoryBufferLength(len(data))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)


def pictures_in_browser(path, folder):
    """How many pictures of a page a browser shows."""
    copy = Path(folder) / "opened.html"
    copy.write_text(Path(path).read_text(encoding="utf-8").replace(
        "</body>", "<script>onload = () => { document.title = "
        "[...document.images].filter(i => i.naturalWidth > 200).length }</script></body>"), encoding="utf-8")
    done = subprocess.run([BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--dump-dom",
                           f"--user-data-dir={folder}/profile", copy.as_uri()],
                          capture_output=True, text=True, timeout=300)
    return int(re.search("<title>([0-9]+)</title>", done.stdout)[1])
