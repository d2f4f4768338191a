"""A picture of the screen, judged coarsely: smoke never looks the same twice, the tank around it does."""


class Picture:
    COLUMNS, ROWS = 32, 18

    def __init__(self, width, height, rgb):
        self.width, self.height, self.rgb = width, height, rgb

    @classmethod
    def read(cls, path):
        data = path.read_bytes()
        magic, width, height, most, rgb = data.split(maxsplit=4)[:4] + [None]
        if magic != b"P6" or most != b"255":
            raise ValueError(f"{path} is no PPM of 8 bits")
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

    def likeness(self, other):
        """Correlation of the fields: 1 the same picture, 0 nothing in common."""
        a, b = self.mean(), other.mean()
        both = sum((x - a) * (y - b) for x, y in zip(self.blocks(), other.blocks())) / len(self.blocks())
        spread = self.contrast() * other.contrast()
        return both / spread if spread else 0.0

    def change(self, other):
        """Mean difference of the fields, 0 to 255."""
        return sum(abs(x - y) for x, y in zip(self.blocks(), other.blocks())) / len(self.blocks())
