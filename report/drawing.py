"""What rendered pictures of the report are made with: motions, views of them, paper, words, PNG files, loops.

mujoco is imported where a view is made: where there is no GL, importing it may fail.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

MEDIA = Path(__file__).resolve().parent / "_static" / "media"
FACE = MEDIA.parents[1] / "figures" / "kit" / "fonts" / "OrientationSans-Bold.ttf"
INK, PAPER = (28, 36, 48), (255, 255, 255)
COLOURS = 128  # of a PNG's palette: shading of plain shapes needs no more
HALF = (360, 340)  # pixels of a loop's each half
WHOLE = (0.0, 0.0, 1.0, 1.0)  # what is kept of a view: left, top, right, bottom, as shares of its sides
LINE = 36  # of words above and below
FRAMES_PER_S = 25
ENCODERS = {
    "webm": ("libvpx-vp9", ["-crf", "38", "-b:v", "0"]),
    "mp4": ("libx264", ["-crf", "27", "-movflags", "+faststart"]),
}
PLAIN = ["-an", "-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"]


class Motion(NamedTuple):
    """An episode as a picture needs it: time step [s], and a pose each tick, whatever its puppet takes for one."""

    dt_s: float
    poses: Sequence

    def at(self, time_s: float) -> Any:
        """Return the pose at a time; the last one once the episode has ended."""
        return self.poses[min(round(time_s / self.dt_s), len(self.poses) - 1)]

    def frames(self, until_s: float, frames_per_s: float = FRAMES_PER_S) -> Iterator:
        """Poses frame by frame."""
        return (self.at(number / frames_per_s) for number in range(round(until_s * frames_per_s)))


class View:
    """A camera on a puppet, which has a `model` and `data` of MuJoCo and can `follow` a pose.

    Args:
        size: of a picture, in pixels. camera: its name in the model, or MuJoCo's own. part: what is kept of the view.
    """

    def __init__(self, puppet, size: tuple[int, int], camera, part=WHOLE):
        import mujoco

        shares = part[2] - part[0], part[3] - part[1]
        width, height = (round(side / share) for side, share in zip(size, shares, strict=True))
        self.puppet, self.camera = puppet, camera
        self.renderer = mujoco.Renderer(puppet.model, height, width)
        left, top = round(part[0] * width), round(part[1] * height)
        self.box = left, top, left + size[0], top + size[1]

    def picture(self, pose):
        """Return a PIL image of the pose."""
        from PIL import Image

        self.puppet.follow(pose)
        self.renderer.update_scene(self.puppet.data, camera=self.camera)
        return Image.fromarray(self.renderer.render()).crop(self.box)

    def close(self) -> None:
        """Free what GL holds; to be called before the next view is made where this one is not kept."""
        self.renderer.close()


def written(image, place: tuple[int, int], text: str, size: int, **anchor):
    """Return the image with a line of text on it."""
    from PIL import ImageDraw, ImageFont

    ImageDraw.Draw(image).text(place, text, fill=INK, font=ImageFont.truetype(str(FACE), size), **anchor)
    return image


def sheet(width: int, height: int):
    """White paper."""
    from PIL import Image

    return Image.new("RGB", (width, height), PAPER)


def save(image, name: str) -> None:
    """Save the image as a PNG with a palette."""
    image.quantize(COLOURS, dither=0).save(MEDIA / name, optimize=True)


def side_by_side(pictures: list, titles: list[str], below: str):
    """Pictures of the size HALF in a row, each with its title above, and a line below them all."""
    width, height = HALF
    image = sheet(width * len(pictures), height + 2 * LINE)
    for place, (picture, title) in enumerate(zip(pictures, titles, strict=True)):
        image.paste(picture, (place * width, LINE))
        written(image, (place * width + width // 2, LINE - 10), title, 24, anchor="ms")
    return written(image, (width * len(pictures) // 2, height + 2 * LINE - 10), below, 22, anchor="ms")


def loop(name: str, shown: dict[str, tuple[View, Motion]], until_s: float, slower: float, note="", poster_s=None):
    """A loop of motions side by side at equal times, by title; its poster is the picture at a time, or the last one."""
    per_s = FRAMES_PER_S * slower
    poses = zip(*(motion.frames(until_s, per_s) for _, motion in shown.values()), strict=True)
    images = []
    for number, both in enumerate(poses):
        pictures = [view.picture(pose) for (view, _), pose in zip(shown.values(), both, strict=True)]
        images.append(side_by_side(pictures, list(shown), f"{number / per_s:.2f} s{note}"))
    encode(images, name, len(images) - 1 if poster_s is None else round(poster_s * per_s))


def encode(images: list, name: str, poster: int) -> None:
    """Encode a loop in both codecs, and one of its images as its poster."""
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
