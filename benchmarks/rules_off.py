"""Scenes with rules of the steps switched off, as a program: ``python -P rules_off.py FOLDER``.

Requests and answers are those of ratio_scenes.py; the keyword `without` names rules of `RULES`. Another version runs
the scenes, too, with none of them named.
"""

import sys
from contextlib import ExitStack
from pathlib import Path

if not __package__:  # run as a file: the package that is installed goes before that of the checkout
    sys.path.append(str(Path(__file__).parents[1]))
from benchmarks import ratio_scenes
from validation.replacing import replaced

RULES = {
    "soil at mid-step": ("model.entrainment", "EROSION_TIME", 0.0),
    "even ground": ("model.step_rule", "EVEN", 1.0),
}
"""Rules: a module, a name in it, and the value with which the rule does nothing."""


def without(scene):
    """Return a scene that takes the rules to be switched off."""

    def run(without, **keywords):
        with ExitStack() as stack:
            for rule in without:
                stack.enter_context(replaced(*RULES[rule]))
            return scene(**keywords)

    return run


SCENES = {scene.__name__: without(scene) for scene in (ratio_scenes.to_rest, ratio_scenes.s1000)}

if __name__ == "__main__":
    ratio_scenes.answer(SCENES)
