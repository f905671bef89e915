"""Colours of scene files, and anchors as GitHub makes them: a hook of MkDocs."""
import re
import sys
import types

import pygments.lexers
from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Literal, Name, Number, Operator, Punctuation, String, Text

WORD = r"[A-Za-z_][A-Za-z0-9_-]*"


class RayLexer(RegexLexer):
    """As editors/vscode has it, in short."""
    name, aliases = "Trace scene", ["ray"]
    tokens = {"root": [
        (r"\s+", Text),
        (r"//.*", Comment.Single),
        (r"/\*(.|\n)*?\*/", Comment.Multiline),
        (r'"[^"\n]*"?', String),
        (r"(?:Trace|SBT-raytracer)\b", Keyword.Namespace),
        (r"(let|define|for|in|if|else|include)(?![\w-])(?!\s*=)", Keyword),
        (r"(and|or|not|deg|rad)(?![\w-])", Operator.Word),
        (r"(pi|tau|time|true|false)(?![\w-])(?!\s*=[^=])", Keyword.Constant),
        (r"#[0-9A-Fa-f]{3,8}\b", Literal),
        (r"(\d+(\.(?!\.)\d*)?|\.\d+)([eE][-+]?\d+)?", Number),
        (rf"({WORD})(\s*)(=)(?!=)", bygroups(Name.Attribute, Text, Operator)),
        (rf"{WORD}(?=\s*\{{)", Name.Class),
        (rf"{WORD}(?=\s*\()", Name.Function),
        (WORD, Name),
        (r"\.\.|[<>=!]=|[-+*/%^<>?:=]", Operator),
        (r".", Punctuation)]}


def anchor(heading, separator):
    """The name by which a link leads to a heading: lower case, blanks as dashes, no other signs."""
    return re.sub(r"[^\w\- ]", "", re.sub(r"<[^>]*>", "", heading).strip().lower()).replace(" ", separator)


def on_config(config):
    module = types.ModuleType("trace_lexer")  # MkDocs gives a hook no name by which Pygments could import it
    module.RayLexer, module.__all__ = RayLexer, ["RayLexer"]
    sys.modules[module.__name__] = module
    pygments.lexers.LEXERS["RayLexer"] = (module.__name__, RayLexer.name, tuple(RayLexer.aliases), (), ())
    config["mdx_configs"]["toc"]["slugify"] = anchor
    return config
