"""Where src/ could be wrong in one place: what libclang finds there to change, one operator, constant or statement each.

A mutant is chosen when a test starts, not when it is compiled: `a < b` becomes `(on(17) ? (a <= b) : (a < b))`. So all
of them are compiled once, and what the compiler itself computes (a constexpr constant, a template argument, a size) is
never changed by one of them.
"""

import dataclasses
import pathlib
import re

from clang import cindex
from clang.cindex import CursorKind as Kind

SWAPS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
         "+": "-", "-": "+", "*": "/", "/": "*", "%": "*", "<<": ">>", ">>": "<<", "&": "|", "|": "&", "^": "&",
         "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "%=": "*=", "<<=": ">>=", ">>=": "<<=",
         "&=": "|=", "|=": "&=", "^=": "&="}
RELATIONS = ("<", "<=", ">", ">=", "==", "!=")
LITERAL = re.compile(r"(0[xX][0-9a-fA-F']+|[0-9][0-9']*)[uUlL]*")
NOTHING = ("{}", "0", "0U", "false", "nullptr", "std::nullopt")
# What the compiler computes, or what no run ever does.
LEFT_OUT = (Kind.STATIC_ASSERT, Kind.ENUM_CONSTANT_DECL, Kind.CXX_UNARY_EXPR, Kind.ALIGNED_ATTR)


@dataclasses.dataclass(frozen=True)
class Mutant:
    file: str  # below the root
    begin: int  # bytes
    end: int
    line: int
    last_line: int
    operator: str
    before: str
    after: str  # what a reader is told
    code: str  # what the compiler is given, with MUTANT for the question whether it is on

    @property
    def room(self) -> str:
        return self.file.split("/")[1]


def one_line(text: str) -> str:
    return re.sub(r"\s*\n\s*", " ", text)


class Finder:
    def __init__(self, root: pathlib.Path):
        self._root = root
        self._texts: dict[str, bytes] = {}
        self.found: dict[tuple, Mutant] = {}

    def read(self, source: pathlib.Path, arguments: list[str]) -> None:
        unit = cindex.Index.create().parse(str(source), args=arguments)
        for cursor in unit.cursor.get_children():
            self._walk(cursor)

    def _walk(self, cursor: cindex.Cursor) -> None:
        """Without recursion into other files, which most of a source is."""
        waiting = [(cursor, None)]
        while waiting:
            at, parent = waiting.pop()
            name = self._name(at)
            if name is None or at.kind in LEFT_OUT or self._is_left_out(at, name):
                continue
            self._look(at, parent, name)
            children = list(at.get_children())
            if at.kind == Kind.CASE_STMT:
                children = children[1:]
            waiting += [(child, at) for child in children]

    def _name(self, cursor: cindex.Cursor) -> str | None:
        file = cursor.extent.start.file
        if file is None:
            return None
        path = pathlib.Path(file.name).resolve()
        return str(path.relative_to(self._root)) if path.is_relative_to(self._root / "src") else None

    def _text(self, name: str, begin: int, end: int) -> str:
        if name not in self._texts:
            self._texts[name] = (self._root / name).read_bytes()
        return self._texts[name][begin:end].decode()

    def _of(self, cursor: cindex.Cursor, name: str) -> str:
        return self._text(name, cursor.extent.start.offset, cursor.extent.end.offset)

    def _is_left_out(self, cursor: cindex.Cursor, name: str) -> bool:
        text = self._of(cursor, name)
        if cursor.kind in (Kind.VAR_DECL, Kind.FIELD_DECL, Kind.UNEXPOSED_DECL):  # the last is a template of a variable
            return re.match(r"(template\s*<[^>]*>\s*)?(static |inline )*constexpr\b", text) is not None
        if cursor.kind in (Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.FUNCTION_TEMPLATE):
            return re.search(r"\bconsteval\b", text.split("{")[0]) is not None or "= default" in text
        return cursor.kind == Kind.CALL_EXPR and re.match(r"(iog::)?require\(", text) is not None

    def _add(self, cursor: cindex.Cursor, name: str, operator: str, after: str, code: str, show: str = "") -> None:
        begin, end = cursor.extent.start.offset, cursor.extent.end.offset
        before = self._text(name, begin, end)
        key = (name, begin, end, operator)
        if begin < end and "#" not in before and "//" not in before:
            self.found.setdefault(key, Mutant(name, begin, end, cursor.extent.start.line, cursor.extent.end.line, operator,
                                              one_line(show or before), one_line(after), code))

    def _look(self, cursor: cindex.Cursor, parent: cindex.Cursor | None, name: str) -> None:
        if cursor.kind in (Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR):
            self._swap(cursor, name)
        elif cursor.kind == Kind.INTEGER_LITERAL:
            text = self._of(cursor, name)
            if LITERAL.fullmatch(text):
                self._add(cursor, name, "constant", f"{text} + 1", f"(MUTANT ? ({text} + 1) : {text})")
        elif cursor.kind == Kind.UNARY_OPERATOR:
            self._unary(cursor, name)
        elif cursor.kind in (Kind.IF_STMT, Kind.WHILE_STMT, Kind.CONDITIONAL_OPERATOR):
            self._condition(cursor, name)
        elif cursor.kind == Kind.RETURN_STMT:
            self._return(cursor, name)
        elif cursor.kind == Kind.CALL_EXPR:
            self._least_or_most(cursor, name)
        if parent is not None and parent.kind == Kind.COMPOUND_STMT:
            self._statement(cursor, name)

    def _swap(self, cursor: cindex.Cursor, name: str) -> None:
        operands = list(cursor.get_children())
        if len(operands) != 2:
            return
        middle = self._text(name, operands[0].extent.end.offset, operands[1].extent.start.offset)
        operator = middle.strip()
        if operator not in SWAPS or all(each.type.kind == cindex.TypeKind.POINTER for each in operands) and operator == "-":
            return
        left, right = (self._of(each, name) for each in operands)
        swapped = f"{left} {SWAPS[operator]} {right}"
        kind = "relation" if operator in RELATIONS else "logic" if operator in ("&&", "||") else "arithmetic"
        self._add(cursor, name, kind, swapped, f"(MUTANT ? ({one_line(swapped)}) : ({self._of(cursor, name)}))")

    def _unary(self, cursor: cindex.Cursor, name: str) -> None:
        text = self._of(cursor, name)
        for operator, other in (("++", "--"), ("--", "++"), ("-", "+"), ("~", "+")):
            if text.startswith(operator):
                other_text = other + text[len(operator):]
                self._add(cursor, name, "arithmetic", other_text, f"(MUTANT ? ({one_line(other_text)}) : ({text}))")
                return

    def _condition(self, cursor: cindex.Cursor, name: str) -> None:
        condition = next(cursor.get_children(), None)
        if condition is None or not condition.kind.is_expression():
            return
        if cursor.kind != Kind.CONDITIONAL_OPERATOR and not re.match(r"(if|while) \(", self._of(cursor, name)):
            return  # if constexpr
        text = self._of(condition, name)
        self._add(condition, name, "condition", f"!({text})", f"(MUTANT != static_cast<bool>({text}))")

    def _return(self, cursor: cindex.Cursor, name: str) -> None:
        value = next(cursor.get_children(), None)
        text = self._of(cursor, name)
        if value is None or self._of(value, name) in NOTHING:
            return
        if value.type.kind == cindex.TypeKind.BOOL:
            expression = self._of(value, name)
            self._add(cursor, name, "return", f"return !({expression})",
                      f"return (MUTANT != static_cast<bool>({expression}))")
        else:
            self._add(cursor, name, "return", "return {}", f"if (MUTANT) {{ return {{}}; }} else {text}")

    def _least_or_most(self, cursor: cindex.Cursor, name: str) -> None:
        text = self._of(cursor, name)
        for one, other in (("std::min", "std::max"), ("std::max", "std::min")):
            if re.match(rf"{one}[(<]", text):
                swapped = other + text[len(one):]
                self._add(cursor, name, "least or most", swapped, f"(MUTANT ? {one_line(swapped)} : {text})")

    def _statement(self, cursor: cindex.Cursor, name: str) -> None:
        text = self._of(cursor, name)
        if cursor.kind in (Kind.CALL_EXPR, Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR,
                           Kind.UNARY_OPERATOR, Kind.UNEXPOSED_EXPR) and not re.match(r"(iog::)?require\(", text):
            self._add(cursor, name, "statement", "(nothing)", f"if (MUTANT) {{}} else {text}")
