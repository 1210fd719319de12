"""What rendered pictures of the report are put together with: paper, words, PNG files, loops in two codecs."""

from __future__ import annotations

from pathlib import Path

MEDIA = Path(__file__).resolve().parent / "_static" / "media"
FACE = MEDIA.parents[1] / "figures" / "kit" / "fonts" / "OrientationSans-Bold.ttf"
INK, PAPER = (28, 36, 48), (255, 255, 255)
COLOURS = 128  # of a PNG's palette: shading of plain shapes needs no more
HALF = (360, 340)  # pixels of a loop's each half
LINE = 36  # of words above and below
FRAMES_PER_S = 25
ENCODERS = {
    "webm": ("libvpx-vp9", ["-crf", "38", "-b:v", "0"]),
    "mp4": ("libx264", ["-crf", "27", "-movflags", "+faststart"]),
}
PLAIN = ["-an", "-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"]


def written(image, place: tuple[int, int], text: str, size: int, **anchor):
    """The image with a line of text on it."""
    from PIL import ImageDraw, ImageFont

    ImageDraw.Draw(image).text(place, text, fill=INK, font=ImageFont.truetype(str(FACE), size), **anchor)
    return image


def sheet(width: int, height: int):
    """White paper."""
    from PIL import Image

    return Image.new("RGB", (width, height), PAPER)


def save(image, name: str) -> None:
    """As a PNG with a palette."""
    image.quantize(COLOURS, dither=0).save(MEDIA / name, optimize=True)


def side_by_side(pictures: list, titles: list[str], below: str):
    """Pictures of the size HALF in a row, each with its title above, and a line below them all."""
    width, height = HALF
    image = sheet(width * len(pictures), height + 2 * LINE)
    for place, (picture, title) in enumerate(zip(pictures, titles, strict=True)):
        image.paste(picture, (place * width, LINE))
        written(image, (place * width + width // 2, LINE - 10), title, 24, anchor="ms")
    return written(image, (width * len(pictures) // 2, height + 2 * LINE - 10), below, 22, anchor="ms")


def encode(images: list, name: str, poster: int) -> None:
    """A loop in both codecs, and one of its images as its poster."""
    import imageio_ffmpeg
    import numpy as np

    for kind, (codec, options) in ENCODERS.items():
        writer = imageio_ffmpeg.write_frames(
            str(MEDIA / f"{name}.{kind}"),
            images[0].size,
            fps=FRAMES_PER_S,
            codec=codec,
            macro_block_size=2,
            ffmpeg_log_level="error",
            output_params=[*options, *PLAIN],
        )
        writer.send(None)
        for image in images:
            writer.send(np.ascontiguousarray(image))
        writer.close()
    save(images[poster], f"{name}.png")
