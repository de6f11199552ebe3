"""Markdown with formulas between dollar signs, typeset as MathML without any script."""

from __future__ import annotations

import re
from functools import cache

from latex2mathml.converter import convert
from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.rules_inline import StateInline
from markupsafe import Markup, escape

from recontrol.report import plaintext


def formula(latex: str, display: bool = False) -> Markup:
    """Return a formula as MathML; one that cannot be read is shown as its source."""
    try:
        mathml = convert(latex, display="block" if display else "inline")
    except Exception:  # the converter raises many kinds; a broken formula must not lose the page
        return Markup("<code>%s</code>") % latex
    return Markup(mathml.replace("<math ", f'<math alttext="{escape(latex)}" ', 1))


def _math_rule(state: StateInline, silent: bool) -> bool:
    match = re.compile(r"(\$\$?)(?=\S)(.+?)(?<=\S)\1(?!\d)", re.S).match(state.src, state.pos)
    if match is None:
        return False
    if not silent:
        token = state.push("formula", "math", 0)
        token.content, token.markup = match[2], match[1]
    state.pos = match.end()
    return True


def _render_formula(renderer: RendererHTML, tokens: list, index: int, options: object, env: object) -> str:
    return str(formula(tokens[index].content, display=tokens[index].markup == "$$"))


@cache
def _parser() -> MarkdownIt:
    parser = MarkdownIt("commonmark", {"html": False, "typographer": False}).enable("table")
    parser.inline.ruler.before("escape", "formula", _math_rule)
    parser.add_render_rule("formula", _render_formula)
    return parser


def inline(text: str | None) -> Markup:
    """Return one line of Markdown with formulas; a line that is a plain-text formula as a whole is typeset too."""
    whole = plaintext.latex((text or "").strip())
    if whole is not None:
        return formula(whole)
    return Markup(_parser().renderInline(" ".join((text or "").split())))


def notes(text: str) -> Markup:
    """Return NOTES.md as HTML: its title dropped, its ``## id`` headings as anchors ``note-id`` of level 3."""
    parser = _parser()
    tokens = parser.parse(re.sub(r"\A\s*# [^\n]*\n", "", text))
    for k, token in enumerate(tokens):
        if token.type in ("heading_open", "heading_close"):
            level = min(int(token.tag[1]) + 1, 6)
            if token.type == "heading_open":
                token.attrSet("id", "note-" + anchor(tokens[k + 1].content))
            token.tag = f"h{level}"
    html = parser.renderer.render(tokens, parser.options, {})
    return Markup(
        html.replace("<table>", '<div class="scroll" tabindex="0"><table>').replace("</table>", "</table></div>")
    )


def anchor(text: str) -> str:
    """Return a text as an anchor: a note's id stays as it is."""
    return re.sub(r"[^a-z0-9.]+", "-", text.strip().lower()).strip("-")
