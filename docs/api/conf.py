# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of the Python package `breast` by Sphinx; tests/tools/api.sh lists its modules and starts Sphinx."""
import re

import breast
from sphinx.application import Sphinx

project = "libbreast"
version = breast.__version__
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
default_role = "code"
napoleon_use_ivar = True
autodoc_member_order = "bysource"
# What `breast` takes from its modules is described there, once.
autodoc_default_options = {"ignore-module-all": True}
# An annotation may name a class by its short name, which several modules have.
suppress_warnings = ["ref.python"]
html_copy_source = False
html_show_sourcelink = False


def public_names(app: Sphinx, page: str, text: list[str]) -> None:
    """Adds the public names, each with a link to its description, to the first page."""
    if page == "index":
        text[0] += "".join(f"- :obj:`breast.{name} <breast.{breast._HOME[name]}.{name}>`\n" for name in breast.__all__)


def keep_shapes(app: Sphinx, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Keeps a shape such as (3) or (N) at the beginning of a description, where it would be the number of a list."""
    lines[:] = [re.sub(r"^( *(?:[\w, ]+: )?)\((\w+)\)", r"\1\\(\2)", line) for line in lines]


def setup(app: Sphinx) -> None:
    app.connect("autodoc-process-docstring", keep_shapes, priority=1)  # before napoleon
    app.connect("source-read", public_names)
