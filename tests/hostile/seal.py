"""Checkpoints that are changed inside, with the hashes that belong to them: otherwise only the hash is read."""

from xxh3 import xxh3

HASH = 8


def hashed(data):
    return xxh3(data).to_bytes(HASH, "little") if len(data) > 240 else bytes(HASH)


def varint(data, at):
    """The number that begins there, and where it ends."""
    value = shift = 0
    while True:
        value |= (data[at] & 0x7F) << shift
        shift += 7
        at += 1
        if data[at - 1] < 0x80:
            return value, at


def as_varint(value):
    out = bytearray()
    while value >= 0x80:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes(out + bytes([value]))


def world(data):
    """Where the state of the world begins and ends, behind two texts, a time and a number."""
    at = 0
    for _ in range(2):
        length, at = varint(data, at)
        at += length
    _, at = varint(data, at + 8)
    length, first = varint(data, at)
    return at, first, first + length


def checkpoint(random, data, change):
    """A checkpoint whose world, or all else, was changed."""
    body = data[:-HASH]
    at, first, end = world(body)
    if random.random() < 0.5:
        inner = change(body[first:end - HASH])
        inner += hashed(inner)
        body = body[:at] + as_varint(len(inner)) + inner + body[end:]
    else:
        # The fingerprint of the run comes first; changed, it refuses everything behind it.
        head = varint(body, 0)[0] + 1
        body = body[:head] + change(body[head:at]) + body[at:end] + change(body[end:])
    return body + hashed(body)


def pages(random, data, change):
    """A log of tables, of which one batch was changed: each is its length, its hash and itself."""
    at, batches = 0, []
    while at + 12 <= len(data):
        length = int.from_bytes(data[at: at + 4], "little")
        batches.append(data[at + 12: at + 12 + length])
        at += 12 + length
    long = [it for it, batch in enumerate(batches) if len(batch) > 240]
    it = random.choice(long or range(len(batches)))
    before, after = (b"".join(packed(it) for it in part) for part in (batches[:it], batches[it + 1:]))
    # It keeps its length: the checkpoint says how long the log is.
    new = change(batches[it])[: len(batches[it])]
    return before + packed(new + bytes(len(batches[it]) - len(new))) + after


def packed(batch):
    return len(batch).to_bytes(4, "little") + hashed(batch) + batch
