"""Settings of Sphinx for the site of tools/site, whose folder of sources docs/site/pages.py prepares."""

import os
import re

project = "holdfast"
author = "the authors of holdfast"
root_doc = "docs/site/index"
# What the links of the pages lead to, such as examples, lies there as well.
include_patterns = [
    "*.md",
    "bench/README.md",
    "data/README.md",
    "docs/*.md",
    "docs/site/*.md",
    "docs/site/gallery/*.md",
    "docs/site/cpp/*.rst",
]
exclude_patterns = ["docs/python", "examples", "tools"]

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
myst_heading_anchors = 4
breathe_projects = {"holdfast": os.environ["HOLDFAST_DOXYGEN_XML"]}
breathe_default_project = "holdfast"
breathe_domain_by_extension = {"hpp": "cpp"}
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_type_aliases = {name: name for name in ("Range", "Interval", "Path")}
add_module_names = False
maximum_signature_line_length = 100

# Nothing of the site is loaded from elsewhere.
html_theme = "furo"
html_title = "holdfast"
html_copy_source = False
html_show_sourcelink = False
html_static_path = [os.path.join(os.path.dirname(__file__), "style")]
html_css_files = ["wide_tables.css"]
html_show_copyright = False


def setup(app):
    """Aliases of types are called by their names in signatures."""

    def named(app, what, name, thing, options, signature, returned):
        names = [text and re.sub(r"TypeAliasForwardRef\('(\w+)'\)", r"\1", text) for text in (signature, returned)]
        return tuple(names)

    app.connect("autodoc-process-signature", named)
