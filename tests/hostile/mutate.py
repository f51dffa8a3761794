"""Mutations of a file: what a careless program, a broken disk or a hostile hand makes of it."""

import re

# Values that are odd in place of a number or a word.
ODD = [b"", b"0", b"-1", b"1", b"nan", b"inf", b"-inf", b"1e308", b"-1e308", b"1e-308", b"99999999999999999999",
       b"9223372036854775807", b"4294967296", b"-0.0", b"0.5", b"1e6", b"none", b"true"]
# Bytes that are odd between others.
SCRAP = [b"\0", b"\xff\xfe", b"\xc3\x28", b"\xef\xbb\xbf", b"\r", b"\n\n", b"\"", b"'", b"<", b"/>", b"&", b"[", b"}",
         b"=", b",", b";", b"<!--", b"\xe2\x80\xa8", b"\x1b[31m", b"../", b"PAR1"]
NUMBER = re.compile(rb"(?<![\w.])-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
WORD = re.compile(rb"[A-Za-z_][A-Za-z_0-9-]*|-?\d[\d.]*")


def place(random, data):
    """A range of at most an eighth of the data, more often a short one."""
    longest = max(1, min(len(data) // 8, 1 << random.randrange(12)))
    first = random.randrange(len(data) + 1)
    return first, min(len(data), first + random.randint(1, longest))


def flip(random, data):
    """Some bits of some bytes."""
    data = bytearray(data)
    for _ in range(random.choice([1, 1, 2, 8])):
        data[random.randrange(len(data))] ^= 1 << random.randrange(8)
    return bytes(data)


def overwrite(random, data):
    """Bytes replaced by the least, the largest or any others."""
    data = bytearray(data)
    for _ in range(random.choice([1, 1, 4])):
        data[random.randrange(len(data))] = random.choice([0, 1, 0x7F, 0x80, 0xFF, random.randrange(256)])
    return bytes(data)


def delete(random, data):
    first, end = place(random, data)
    return data[:first] + data[end:]


def repeat(random, data):
    first, end = place(random, data)
    return data[:end] + data[first:end] * random.choice([1, 1, 2, 20]) + data[end:]


def move(random, data):
    first, end = place(random, data)
    rest = data[:first] + data[end:]
    to = random.randrange(len(rest) + 1)
    return rest[:to] + data[first:end] + rest[to:]


def truncate(random, data):
    return data[: random.randrange(len(data))]


def insert(random, data):
    at = random.randrange(len(data) + 1) if random.random() < 0.8 else 0
    return data[:at] + random.choice(SCRAP) + data[at:]


def replaced(random, data, pattern, values):
    """Some of what the pattern finds, replaced by one of the values."""
    found = list(pattern.finditer(data))
    if not found:
        return overwrite(random, data)
    # From the last on, so that the places of the others stay.
    for it in sorted(random.sample(found, min(len(found), random.choice([1, 1, 1, 2, 5]))), key=lambda it: -it.start()):
        data = data[: it.start()] + values(it.group()) + data[it.end():]
    return data


def number(random, data):
    """Numbers replaced by odd ones, or ones with more digits, another sign or another power of ten."""
    def other(text):
        if random.random() < 0.7:
            return random.choice(ODD)
        return random.choice([b"-" + text, text + b"0", text + text, text + b"e9", text[:-1], text + b"e-9"])
    return replaced(random, data, NUMBER, other)


def word(random, data):
    """Words and ids replaced by others of the same file."""
    words = WORD.findall(data) or [b"x"]
    return replaced(random, data, WORD, lambda _: random.choice(words))


def line(random, data):
    """A line left out, repeated or moved."""
    lines = data.split(b"\n")
    at, to = random.randrange(len(lines)), random.randrange(len(lines))
    deed = random.randrange(4)
    if deed == 0:
        del lines[at]
    elif deed == 1:
        lines[at:at] = [lines[at]] * random.choice([1, 3, 100])
    elif deed == 2:
        lines[at], lines[to] = lines[to], lines[at]
    else:
        lines.insert(to, lines.pop(at))
    return b"\n".join(lines)


TEXT = [number, number, number, word, word, line, line, flip, overwrite, delete, repeat, move, truncate, insert]
BINARY = [flip, flip, overwrite, overwrite, delete, repeat, move, truncate, insert]


def mutated(random, data, is_text):
    """Data with one to four mutations, and how they are called."""
    names = []
    for _ in range(random.choice([1, 1, 1, 2, 4])):
        if not data:
            break
        way = random.choice(TEXT if is_text else BINARY)
        data = way(random, data)
        names.append(way.__name__)
    return data, names
