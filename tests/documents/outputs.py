"""Whether the output that a document shows is what a command prints.

A line "..." stands for any lines, "..." in a line for any text, and blanks for blanks and line breaks. Whole numbers
are equal, others to three digits; those of a line about a method of SUNDIALS or the agreement of references, which
differ between its versions, to a factor of two. Times are not compared.
"""

import re

NUMBER = r"[-+]?(?:\d+(?:\.\d*)?(?:e[-+]?\d+)?|nan|inf)"
WORD = re.compile(rf"[(<]?({NUMBER})[,;:.)]*")
COLUMN = re.compile(r"(?:wall time|ns a|time \[ns\])(?=  |\s*$)")  # of times, aligned to the right
TIMED = re.compile(rf"(?:wall time|\(median|took|its\s+runs|it\s+takes|takes|takes up\s+to|there\s+in|scene\s+takes)\s+({NUMBER})|\(({NUMBER}) times less|({NUMBER}) % longer")
SUNDIALS = re.compile(r"\s*(?:(?:cvode|arkode)-|floor )")
CLOSE, LOOSE = 5e-3, 2.0


def tokens(shown):
    """(start, end, kind) of the words of a text; the kind of numbers is "number", "loose" or "time", of others ""."""
    timed = {match.span(group) for match in TIMED.finditer(shown) for group in (1, 2, 3) if match[group]}
    ends, place, found = set(), 0, []
    for line in shown.splitlines(keepends=True):
        ends = {match.end() for match in COLUMN.finditer(line)} or ends
        usual = "loose" if SUNDIALS.match(line) else "number"
        for word in re.finditer(r"\S+", line):
            inner = None if "..." in word[0] else WORD.fullmatch(word[0])
            first, last = (word.start() + at for at in (inner.span(1) if inner else (0, len(word[0]))))
            span = place + first, place + last
            in_column = last in ends and line[:word.start()].endswith("  ")
            kind = ("time" if span in timed or in_column else usual) if inner else ""
            found.append((*span, kind))
        place += len(line)
    return found


def pattern(shown, words):
    """An expression for what has these words of `shown`, with a group for each number."""
    parts, end = [r"^[ \t]*"], words[0][0]
    for first, last, kind in words:
        parts.append(r"\s+".join(map(re.escape, re.split(r"\s+", shown[end:first].rstrip("<")))))
        parts.append(rf"<?({NUMBER})" if kind == "time" else rf"({NUMBER})" if kind else re.escape(shown[first:last]).replace(r"\.\.\.", ".*?"))
        end = last
    parts.append(re.escape(re.match(r"\S*", shown[end:])[0]) + r"[ \t]*$")
    return re.compile("".join(parts), re.MULTILINE)


def is_close(shown, printed, kind):
    if kind == "time" or shown == printed:
        return True
    a, b = float(shown), float(printed)
    if kind == "loose":
        return a * b > 0 and max(a / b, b / a) <= LOOSE
    whole = re.fullmatch(r"[-+]?\d+", shown) and re.fullmatch(r"[-+]?\d+", printed)
    return not whole and abs(a - b) <= CLOSE * max(abs(a), abs(b))


def agrees(shown, words, match):
    numbers = [word for word in words if word[2]]
    return all(is_close(shown[a:b], printed, kind) for (a, b, kind), printed in zip(numbers, match.groups(), strict=True))


def pieces(shown):
    """The words of each piece between lines "..."; empty where such a line is the first or the last."""
    found = [[]]
    for word in tokens(shown):
        alone = re.search(r"(?:^|\n)[ \t]*$", shown[:word[0]]) and re.match(r"[ \t]*(?:\n|$)", shown[word[1]:])
        if shown[word[0]:word[1]] == "..." and alone:
            found.append([])
        else:
            found[-1].append(word)
    return found


def places(shown, printed):
    """For each piece: (its words, its match in the printed text or None, whether that agrees)."""
    found, end = [], 0
    for words in filter(None, pieces(shown)):
        matches = list(pattern(shown, words).finditer(printed, end))
        best = next((match for match in matches if agrees(shown, words, match)), matches[0] if matches else None)
        found.append((words, best, best is not None and agrees(shown, words, best)))
        end = best.end() if best else end
    return found


def same(shown, printed):
    """Whether all pieces are there in order, and nothing else where there is no line "..."."""
    found, parts = places(shown, printed), pieces(shown)
    if not all(agree for _, _, agree in found):
        return False
    if not parts[0] and not parts[-1] and not found:
        return len(parts) > 1 or not printed.strip()
    head, tail = printed[:found[0][1].start()], printed[found[-1][1].end():]
    return (not parts[0] or not head.strip()) and (not parts[-1] or not tail.strip())
