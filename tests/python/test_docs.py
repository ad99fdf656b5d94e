"""Docstrings are complete, and their examples give the results that they show."""

import dataclasses
import doctest
import importlib
import pkgutil
import re

import flapwing
import flapwing.analysis
import flapwing.plot
import pytest

MODULES = [module.name for module in pkgutil.walk_packages(flapwing.__path__, "flapwing.")]


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    module = importlib.import_module(name)
    failed, _ = doctest.testmod(module, extraglobs={"flapwing": flapwing}, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert failed == 0


def test_public_functions_say_what_they_take_give_and_raise():
    for module in [flapwing, flapwing.analysis, flapwing.fitting, flapwing.plot]:
        for name in module.__all__:
            thing = getattr(module, name)
            assert name == "__version__" or thing.__doc__, name
            if callable(thing) and not isinstance(thing, type) and name not in ("presets", "label"):
                for heading in ["Parameters\n", "Returns\n", "Raises\n"]:
                    assert heading in thing.__doc__, (name, heading)


def test_every_attribute_of_a_result_is_documented():
    for module in [flapwing, flapwing.analysis, flapwing.fitting]:
        for name in module.__all__:
            thing = getattr(module, name)
            for field in dataclasses.fields(thing) if dataclasses.is_dataclass(thing) else ():
                assert re.search(rf"^    (\w+, )*{field.name}(, \w+)* : ", thing.__doc__, re.MULTILINE), (
                    name,
                    field.name,
                )
