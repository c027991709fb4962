"""Encoders: pictures, one after the other, as the bytes of a film: MP4 by PyAV, GIF and WebP by Pillow."""

import importlib.util
import itertools
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from io import BytesIO
from pathlib import Path
from typing import IO, Any, Final, TypeAlias

import numpy as np
from PIL import Image

from reactive4d.errors import Reactive4dError, ShapeError, UnknownNameError, hint

__all__ = ["ENCODERS", "check_encoder"]

# What writes a file: the file, the pictures (H, W, 3), some of them in advance, how many there are, how many per
# second, and whether they begin again at the end.
Encoder: TypeAlias = Callable[..., None]
Few: TypeAlias = Callable[[int], list[Any]]

SAMPLES = 8  # pictures from which the colours of a GIF are chosen
QUALITY = 88  # of a WebP's pictures, of 100
CRF = "17"  # of H.264: the lower, the nearer to the pictures
BT709 = 1


def check_encoder(path: Path, *, size: tuple[int, int], rate: float) -> None:
    """Refuse what cannot be written, before anything is drawn.

    Raises:
        UnknownNameError: there is no such format.
        ShapeError: it does not know this size, or this rate.
        Reactive4dError: it needs a library that is not there.

    >>> check_encoder(Path("film.mp4"), size=(641, 480), rate=25)
    Traceback (most recent call last):
    ...
    reactive4d.errors.ShapeError: size: the width and the height of an .mp4 are even, got (641, 480)
    hint: size=(640, 480)
    """
    end = path.suffix.lower()
    if end not in ENCODERS:
        raise hint(UnknownNameError(f"{path.name}: no films that end with {end}"), f"films are {', '.join(ENCODERS)}")
    if end == ".mp4":
        if importlib.util.find_spec("av") is None:
            raise hint(Reactive4dError(f"{path.name}: an .mp4 needs PyAV"), "pip install 'reactive4d[films]'")
        even = size[0] - size[0] % 2, size[1] - size[1] % 2
        if even != size or 0 in even:
            error = ShapeError(f"size: the width and the height of an .mp4 are even, got {size}")
            raise hint(error, f"size={max(even[0], 2), max(even[1], 2)}")
    if end == ".gif" and rate > 50:
        raise hint(ShapeError(f"rate: a .gif shows at most 50 pictures per second, got {rate:g}"), "rate=25")


def mp4(file: IO[bytes], pictures: Iterator[Any], few: Few, *, count: int, rate: float, loop: bool) -> None:
    """H.264, as all browsers play it."""
    import av  # pyright: ignore[reportMissingImports]

    films: Any = av
    with films.open(file.name, mode="w", format="mp4", options={"movflags": "faststart"}) as container:
        stream: Any = None
        for picture in pictures:
            if stream is None:
                stream = container.add_stream("libx264", rate=Fraction(rate).limit_denominator(1001))
                stream.height, stream.width = picture.shape[:2]
                stream.pix_fmt = "yuv420p"
                stream.options = {"crf": CRF, "preset": "medium"}
                # Which red is red: players of small films would guess otherwise.
                look = stream.codec_context
                look.color_primaries = look.color_trc = look.colorspace = BT709
                look.color_range = 1
            frame = films.VideoFrame.from_ndarray(np.ascontiguousarray(picture), format="rgb24")
            for packet in stream.encode(frame.reformat(format="yuv420p", dst_colorspace="ITU709")):
                container.mux(packet)
        for packet in stream.encode():
            container.mux(packet)


def gif(file: IO[bytes], pictures: Iterator[Any], few: Few, *, count: int, rate: float, loop: bool) -> None:
    """In 256 colours, the same for all pictures, so that what rests does not flicker."""
    palette = _palette(few(SAMPLES))
    strip = _Strip((_quantized(picture, palette) for picture in pictures), count)
    forever: Any = {"loop": 0} if loop else {}
    durations = [10 * each for each in _durations(count, 100.0 / rate)]
    strip.save(file, "GIF", save_all=True, duration=durations, disposal=1, optimize=False, **forever)


def webp(file: IO[bytes], pictures: Iterator[Any], few: Few, *, count: int, rate: float, loop: bool) -> None:
    """In all colours, and small."""
    strip = _Strip((Image.fromarray(picture) for picture in pictures), count)
    durations = _durations(count, 1000.0 / rate)
    made = BytesIO()
    strip.save(made, "WEBP", save_all=True, duration=durations, loop=int(not loop), quality=QUALITY, method=4)
    found = made.getvalue()
    # Of pictures that are all the same Pillow makes a still, which lasts no time.
    file.write(found if found[12:16] == b"VP8X" else _lasting(found[12:], strip.size, sum(durations), loop=loop))


ENCODERS: Final[Mapping[str, Encoder]] = {".mp4": mp4, ".gif": gif, ".webp": webp}


def _lasting(picture: bytes, size: tuple[int, int], duration: int, *, loop: bool) -> bytes:
    """A WebP of one picture that is shown for so many milliseconds (RFC 9649, section 2.7).

    Args:
        picture: the chunk that has its pixels.
        size: of the picture.
        duration: milliseconds.
        loop: whether it begins again.
    """

    def number(value: int) -> bytes:
        return min(value, 2**24 - 1).to_bytes(3, "little")

    def chunk(name: bytes, content: bytes) -> bytes:
        return name + len(content).to_bytes(4, "little") + content + b"\0" * (len(content) % 2)

    sides = number(size[0] - 1) + number(size[1] - 1)
    whole = chunk(b"VP8X", bytes([0b10, 0, 0, 0]) + sides)  # the bit says that it is animated
    whole += chunk(b"ANIM", bytes(4) + (0 if loop else 1).to_bytes(2, "little"))
    whole += chunk(b"ANMF", bytes(6) + sides + number(duration) + bytes(1) + picture)
    return chunk(b"RIFF", b"WEBP" + whole)


def _durations(count: int, each: float) -> list[int]:
    """Whole numbers whose sums are as near as can be to so much for each.

    >>> _durations(4, 3.5)
    [4, 3, 3, 4]
    """
    ends = [round(i * each) for i in range(count + 1)]
    return [stop - start for start, stop in itertools.pairwise(ends)]


def _palette(samples: list[Any]) -> Any:
    """An image whose palette has the colours of some pictures; the commonest one, mostly the paper's, is the first."""
    whole = np.concatenate([sample.reshape(-1, 3)[::7] for sample in samples])
    packed = whole.astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)
    kinds, counts = np.unique(packed, return_counts=True)
    commonest = int(kinds[counts.argmax()])
    rest = Image.fromarray(np.concatenate(samples)).quantize(colors=255, method=Image.Quantize.MEDIANCUT, kmeans=1)
    found = Image.new("P", (1, 1))
    found.putpalette([*commonest.to_bytes(3, "big"), *(rest.getpalette() or [])[: 255 * 3]])
    return found


def _quantized(picture: Any, palette: Any) -> Any:
    """A picture in the colours of a palette. What has its first one has it still: Pillow takes any that is near."""
    image = Image.fromarray(picture).quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
    first = np.array(palette.getpalette()[:3], np.uint8)
    image.paste(0, mask=Image.fromarray((picture == first).all(axis=2)))
    return image


class _Strip(Image.Image):
    """Pictures as one image of Pillow's that is gone through once: none of them is kept."""

    def __init__(self, pictures: Iterator[Any], count: int) -> None:
        super().__init__()
        self.n_frames = count
        self._pictures = pictures
        self._at = -1
        self.seek(0)

    def seek(self, frame: int) -> None:
        """Show the next one."""
        if frame >= self.n_frames:
            raise EOFError
        while self._at < frame:
            picture = next(self._pictures)
            self._at += 1
            self.im, self._mode, self._size = picture.im, picture.mode, picture.size
            self.palette = picture.palette

    def tell(self) -> int:
        """Which one is shown."""
        return self._at
