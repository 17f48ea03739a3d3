"""Formulas by KaTeX, which comes with the site: no page asks the network for anything."""

import html

SCRIPTS = ("katex/katex.min.js", "katex/auto-render.js", "render_math.js")


def write(translator, node, left, right, element):
    translator.body.append(translator.starttag(node, element, "", CLASS="math notranslate nohighlight"))
    translator.body.append(f"{left}{html.escape(node.astext(), quote=False)}{right}</{element}>")


def write_inline(translator, node):
    from docutils.nodes import SkipNode

    write(translator, node, "\\(", "\\)", "span")
    raise SkipNode


def write_block(translator, node):
    from docutils.nodes import SkipNode

    write(translator, node, "\\[", "\\]", "div")
    raise SkipNode


def setup(app):
    app.add_html_math_renderer("katex", (write_inline, None), (write_block, None))
    app.config.html_math_renderer = "katex"
    app.add_css_file("katex/katex.min.css")
    for script in SCRIPTS:
        app.add_js_file(script, loading_method="defer")
    return {"parallel_read_safe": True}
