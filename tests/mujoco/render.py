"""A picture of each robot as it stands, by its own camera and light: docs/*.png of the robots' names.

usage: render.py ROBOTS_FOLDER OUT_FOLDER [NAME...]   (see `run --pictures` beside this file)
"""
import pathlib
import sys

import mujoco
from PIL import Image

import models

WIDTH, HEIGHT = 640, 480


def picture(folder):
    model = mujoco.MjModel.from_xml_path(str(folder / "model.xml"))
    data = mujoco.MjData(model)
    models.stand(model, data, folder)
    renderer = mujoco.Renderer(model, 2 * HEIGHT, 2 * WIDTH)   # twice as large: edges become smooth
    renderer.update_scene(data, camera="follow")
    return Image.fromarray(renderer.render()).resize((WIDTH, HEIGHT), Image.LANCZOS)


def main():
    robots, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    for path in sorted(robots.glob("*/model.xml")):
        if sys.argv[3:] and path.parent.name not in sys.argv[3:]:
            continue
        image = picture(path.parent).quantize(128, dither=Image.Dither.NONE)
        file = out / f"{path.parent.name}.png"
        image.save(file, optimize=True)
        print(f"{file}: {file.stat().st_size} bytes")


main()
