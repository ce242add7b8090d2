"""What mkdocs asks of scripts/site: pages of GitHub's Markdown, none forgotten, and no link that leads nowhere."""
import html.parser
import pathlib
import re
import urllib.parse

from mkdocs.exceptions import PluginError


def on_page_markdown(markdown, **_):
    # Lists within lists stand two spaces in, and Python-Markdown wants four.
    markdown = re.sub(r"^  (?=- )", "    ", markdown, flags=re.MULTILINE)
    # A header of the library is its page in the reference of C++.
    return re.sub(r"\]\(((?:\.\./)*)include/vspring/(\w+)\.hpp\)",
                  lambda link: f"]({link[1]}cpp/{link[2].replace('_', '__')}_8hpp.html)", markdown)


def on_page_content(html, **_):
    # A bar in the code of a table is escaped, and Python-Markdown shows how.
    return re.sub(r"<td.*?</td>", lambda cell: cell[0].replace("\\|", "|"), html, flags=re.DOTALL)


def on_nav(nav, files, **_):
    reached = {page.file.src_uri for page in nav.pages} | {"README.md"}
    nav.homepage = files.get_file_from_path("README.md").page
    forgotten = sorted({file.src_uri for file in files.documentation_pages()} - reached)
    if forgotten:
        raise PluginError(f"mkdocs.yml: nav has no line for {', '.join(forgotten)}")


class Links(html.parser.HTMLParser):
    """What a page leads to, what it loads, and the names that links to it may have."""

    def __init__(self, page):
        super().__init__()
        self.links, self.loads, self.names = [], [], {"", "__top"}
        self.feed(page.read_text())

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names |= {given[key] for key in ("id", "name") if given.get(key)}
        target = given.get("href") or given.get("src")
        if target:
            (self.links if tag == "a" else self.loads).append(target)


def on_post_build(config, **_):
    site = pathlib.Path(config["site_dir"])
    pages = {page: Links(page) for page in site.rglob("*.html")}
    faults = []
    for page, found in pages.items():
        where = page.relative_to(site)
        faults += [f"{where} loads {target}" for target in found.loads if re.match(r"(\w+:)?//", target)]
        if where.name == "404.html":  # of servers, whose addresses begin at their root
            continue
        for target in found.links + found.loads:
            if re.match(r"\w+:|//", target):
                continue
            path, _, name = urllib.parse.unquote(target).partition("#")
            aim = (page.parent / path).resolve() if path else page
            if not aim.is_file():
                faults.append(f"{where}: {target} is not there")
            elif aim in pages and where.parts[0] != "cpp" and name not in pages[aim].names:  # doxygen forgets some of its own
                faults.append(f"{where}: {target}: no such heading")
    if faults:
        raise PluginError("\n".join(faults))
