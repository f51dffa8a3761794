"""XXH3 of 64 bits without a seed, for the hashes at the end of checkpoints. Of more than 240 bytes only."""

ALL = (1 << 64) - 1
P32 = (0x9E3779B1, 0x85EBCA77, 0xC2B2AE3D)
P64 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5)
SECRET = bytes.fromhex(
    "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221"
    "b8084674f743248ee03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8"
    "a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb"
    "170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e"
)
STRIPE = 64


def words(data, at, count):
    return [int.from_bytes(data[at + 8 * it: at + 8 * it + 8], "little") for it in range(count)]


def folded(a, b):
    product = a * b
    return (product & ALL) ^ (product >> 64)


def accumulate(sums, data, at, secret_at):
    for it, (value, key) in enumerate(zip(words(data, at, 8), words(SECRET, secret_at, 8))):
        mixed = value ^ key
        sums[it ^ 1] = (sums[it ^ 1] + value) & ALL
        sums[it] = (sums[it] + (mixed & 0xFFFFFFFF) * (mixed >> 32)) & ALL


def xxh3(data):
    """The hash of `data`."""
    assert len(data) > 240, "shorter data are hashed in other ways"
    sums = [P32[2], P64[0], P64[1], P64[2], P64[3], P32[1], P64[4], P32[0]]
    stripes = (len(SECRET) - STRIPE) // 8
    block = STRIPE * stripes
    blocks = (len(data) - 1) // block
    for number in range(blocks):
        for stripe in range(stripes):
            accumulate(sums, data, number * block + stripe * STRIPE, stripe * 8)
        for it, key in enumerate(words(SECRET, len(SECRET) - STRIPE, 8)):
            sums[it] = ((sums[it] ^ (sums[it] >> 47) ^ key) * P32[0]) & ALL
    for stripe in range((len(data) - 1 - blocks * block) // STRIPE):
        accumulate(sums, data, blocks * block + stripe * STRIPE, stripe * 8)
    accumulate(sums, data, len(data) - STRIPE, len(SECRET) - STRIPE - 7)
    total = len(data) * P64[0] & ALL
    for it in range(4):
        keys = words(SECRET, 11 + 16 * it, 2)
        total += folded(sums[2 * it] ^ keys[0], sums[2 * it + 1] ^ keys[1])
    total &= ALL
    total ^= total >> 37
    total = total * 0x165667919E3779F9 & ALL
    return total ^ (total >> 32)
