"""The pictures of a run, in the order in which they are drawn."""

import angle
import defects
import energy
import extrema
import kymograph
import power
import shapes
from script import Nothing, say
from skein_package import DamagedData, Error

PICTURES = {"shapes": shapes, "angle": angle, "curvature": kymograph, "energy": energy, "extrema": extrema,
            "power": power, "defects": defects}


def draw_pictures(run, options):
    """Names and figures, of those pictures for which the run holds enough; about others there is a note."""
    for name, picture in PICTURES.items():
        try:
            figure = picture.draw(run, options)
        except Nothing as reason:
            say(f"{name} is not drawn: {reason}")
            continue
        except Error:
            raise
        except OSError as error:
            raise DamagedData(f"{run.path} cannot be read: {error}") from None
        for note in options.notes:
            say(note)
        options.notes.clear()
        yield name, figure
