"""A picture of the screen, judged coarsely: smoke never looks the same twice, the tank around it does."""
import struct
import zlib


def rows_of_png(data):
    """Width, height and the bytes of an 8-bit RGB or RGBA PNG as RGB, row by row (ISO/IEC 15948)."""
    at, packed, head = 8, b"", None
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", data[at + 8:at + 21])
        elif kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += size + 12
    width, height, depth, colours, _, _, interlaced = head
    if depth != 8 or colours not in (2, 6) or interlaced:
        raise ValueError("not a plain 8-bit RGB or RGBA PNG")
    bytes_each = 3 if colours == 2 else 4
    raw, row_bytes = zlib.decompress(packed), width * bytes_each
    above, rgb = bytearray(row_bytes), bytearray()
    for y in range(height):
        begin = y * (row_bytes + 1)
        kind, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + row_bytes])
        for x in range(row_bytes if kind else 0):
            left = row[x - bytes_each] if x >= bytes_each else 0
            up = above[x]
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = up
            elif kind == 3:
                guess = (left + up) // 2
            else:
                corner = above[x - bytes_each] if x >= bytes_each else 0
                p = left + up - corner
                guess = min((left, up, corner), key=lambda value: abs(p - value))
            row[x] = (row[x] + guess) & 255
        above = row
        rgb += row if bytes_each == 3 else b"".join(row[x:x + 3] for x in range(0, row_bytes, 4))
    return width, height, bytes(rgb)


class Picture:
    COLUMNS, ROWS = 32, 18

    def __init__(self, width, height, rgb):
        self.width, self.height, self.rgb = width, height, rgb

    @classmethod
    def read(cls, path):
        data = path.read_bytes()
        if data.startswith(b"\x89PNG"):
            return cls(*rows_of_png(data))
        magic, width, height, most, rgb = data.split(maxsplit=4)[:4] + [None]
        if magic != b"P6" or most != b"255":
            raise ValueError(f"{path} is neither a PNG nor a PPM of 8 bits")
        size = int(width) * int(height) * 3
        return cls(int(width), int(height), data[len(data) - size:])

    def blocks(self):
        """Mean brightness, 0 to 255, in each of 32 x 18 fields, by every fourth pixel of every fourth row."""
        if not hasattr(self, "_blocks"):
            across, down = self.width // self.COLUMNS, self.height // self.ROWS
            self._blocks = []
            for row in range(self.ROWS):
                for column in range(self.COLUMNS):
                    total = count = 0
                    for y in range(row * down, (row + 1) * down, 4):
                        begin = (y * self.width + column * across) * 3
                        for channel in range(3):
                            line = self.rgb[begin + channel:begin + across * 3:12]
                            total += sum(line)
                            count += len(line)
                    self._blocks.append(total / count)
        return self._blocks

    def mean(self):
        return sum(self.blocks()) / len(self.blocks())

    def contrast(self):
        mean = self.mean()
        return (sum((b - mean) ** 2 for b in self.blocks()) / len(self.blocks())) ** 0.5

    def is_black(self):
        return self.contrast() < 2.0 and self.mean() < 8.0

    def column_of_orange(self):
        """Where, of 32 columns, what is orange is on the mean: the ball. None if nothing is; smoke, tank and words are not."""
        weight = at = 0.0
        for y in range(0, self.height, 4):
            row = self.rgb[y * self.width * 3:(y + 1) * self.width * 3]
            for x, (red, blue) in enumerate(zip(row[0::12], row[2::12])):
                if red - blue > 60:
                    weight += red - blue
                    at += (red - blue) * x
        return at / weight * 4 * self.COLUMNS / self.width if weight else None

    def likeness(self, other):
        """Correlation of the fields: 1 the same picture, 0 nothing in common."""
        a, b = self.mean(), other.mean()
        both = sum((x - a) * (y - b) for x, y in zip(self.blocks(), other.blocks())) / len(self.blocks())
        spread = self.contrast() * other.contrast()
        return both / spread if spread else 0.0
