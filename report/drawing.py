"""What rendered pictures of the report are made with: motions, views of them, paper, words, PNG files, loops.

mujoco is imported where a view is made: where there is no GL, its renderer may fail. A view that is no longer kept
spoils those that are.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from PIL import Image, ImageDraw, ImageFont

MEDIA = Path(__file__).resolve().parent / "_static" / "media"
FACE = MEDIA.parents[1] / "figures" / "kit" / "fonts" / "OrientationSans-Bold.ttf"
HALF = (360, 340)  # pixels of a loop's each half
LINE = 36  # of words above and below
FRAMES_PER_S = 25
ENCODERS = {
    "webm": ("libvpx-vp9", ["-crf", "38", "-b:v", "0"]),
    "mp4": ("libx264", ["-crf", "27", "-movflags", "+faststart"]),
}
PLAIN = ["-an", "-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"]
WHOLE = (0.0, 0.0, 1.0, 1.0)  # what is kept of a view: left, top, right, bottom, as shares of its sides


class Theme(NamedTuple):
    """How the names of a theme's files end, and the colours of its words and of what is behind an arm."""

    suffix: str
    ink: tuple[int, int, int]
    paper: tuple[int, int, int]


THEMES = Theme("", (28, 36, 48), (255, 255, 255)), Theme("-dark", (230, 234, 240), (20, 24, 30))


class Motion(NamedTuple):
    """An episode as a picture needs it: time step [s], and a pose each tick."""

    dt_s: float
    poses: Sequence

    def frames(self, until_s: float, per_s: float = FRAMES_PER_S) -> Iterator:
        """Yield poses frame by frame; the last one once the episode has ended."""
        for number in range(round(until_s * per_s)):
            yield self.poses[min(round(number / per_s / self.dt_s), len(self.poses) - 1)]


def make_view(
    puppet: Any, size: tuple[int, int], theme: Theme, camera: Any, part: tuple = WHOLE
) -> Callable[[Any], Image.Image]:
    """Return what draws a puppet in a pose on the theme's paper, at a size in pixels."""
    import mujoco

    puppet.model.tex_data[:] = np.resize(theme.paper, puppet.model.tex_data.size)  # the sky is the only texture
    width, height = round(size[0] / (part[2] - part[0])), round(size[1] / (part[3] - part[1]))
    renderer = mujoco.Renderer(puppet.model, height, width)
    left, top = round(part[0] * width), round(part[1] * height)

    def draw(pose: Any) -> Image.Image:
        puppet.follow(pose)
        renderer.update_scene(puppet.data, camera=camera)
        return Image.fromarray(renderer.render()).crop((left, top, left + size[0], top + size[1]))

    return draw


def write_on(image: Image.Image, place: tuple[int, int], text: str, size: int, theme: Theme) -> None:
    """Write a line of text, centred above a place."""
    font = ImageFont.truetype(str(FACE), size)
    ImageDraw.Draw(image).text(place, text, fill=theme.ink, font=font, anchor="ms")


def draw_row(
    pictures: list[Image.Image], titles: list[str], above: int, below: int, at: int, size: int, theme: Theme
) -> Image.Image:
    """Return pictures in a row on paper, with room above and below them, each with its title at a height."""
    width, height = pictures[0].size
    image = Image.new("RGB", (width * len(pictures), height + above + below), theme.paper)
    for place, (picture, title) in enumerate(zip(pictures, titles, strict=True)):
        image.paste(picture, (place * width, above))
        write_on(image, (place * width + width // 2, at), title, size, theme)
    return image


def save(image: Image.Image, name: str) -> None:
    """Save the image as a PNG with a palette of 128 colours: shading of plain shapes needs no more."""
    image.quantize(128, dither=Image.Dither.NONE).save(MEDIA / name, optimize=True)


def encode_loop(
    name: str,
    shown: dict[str, Any],
    theme: Theme,
    loop_s: float,
    slower: float,
    note: str = "",
    poster_s: float = math.inf,
) -> None:
    """Encode motions side by side at equal times, by title, in both codecs; a poster is the picture at a time."""
    per_s, images = FRAMES_PER_S * slower, []
    for number, poses in enumerate(zip(*(motion.frames(loop_s, per_s) for _, motion in shown.values()), strict=True)):
        pictures = [view(pose) for (view, _), pose in zip(shown.values(), poses, strict=True)]
        image = draw_row(pictures, list(shown), LINE, LINE, LINE - 10, 24, theme)
        write_on(image, (image.width // 2, image.height - 10), f"{number / per_s:.2f} s{note}", 22, theme)
        images.append(image)
    encode(f"{name}{theme.suffix}", images, images[min(round(min(poster_s, loop_s) * per_s), len(images) - 1)])


def encode(name: str, images: list[Image.Image], poster: Image.Image) -> None:
    """Encode pictures as a loop in both codecs, and save its poster."""
    import imageio_ffmpeg

    for kind, (codec, options) in ENCODERS.items():
        usual = {"fps": FRAMES_PER_S, "codec": codec, "macro_block_size": 2, "ffmpeg_log_level": "error"}
        file = str(MEDIA / f"{name}.{kind}")
        writer = imageio_ffmpeg.write_frames(file, images[0].size, output_params=[*options, *PLAIN], **usual)
        writer.send(None)
        for image in images:
            writer.send(np.ascontiguousarray(image))
        writer.close()
    save(poster, f"{name}.png")
