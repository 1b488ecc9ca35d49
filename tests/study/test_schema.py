"""What an editor reports about a study from its schema, and what `validate` reports."""

import json
import re
import tomllib

import pytest
from command import call
from folders import STUDIES
from told import refused

from swtstudy import Study

jsonschema = pytest.importorskip("jsonschema")

STUDY_FILES = sorted(STUDIES.glob("*.toml"))
#: The schema beside them, in which editors look.
FILE = "study.schema.json"

THREE_MISTAKES = """
title = "Three mistakes"
[fixed]
frictoin = 0.3
poisson_ratio = 0.7
[axes]
phase = { start = 0, stop = "2*pi", number = 9 }
"""


@pytest.fixture(scope="module")
def validator():
    schema = json.loads((STUDIES / FILE).read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def parameters(schema):
    """The parameters of a point, which come before the sizes of a contact."""
    known = list(schema["properties"]["axes"]["properties"])
    return known[: known.index("young_modulus")]


def test_the_file_beside_the_studies_is_up_to_date():
    assert (STUDIES / FILE).read_text() == call("schema").output, f"swtstudy schema -o studies/{FILE}"


@pytest.mark.parametrize("path", STUDY_FILES, ids=lambda path: path.stem)
def test_the_studies_of_the_paper_point_to_it_and_keep_to_it(path, validator):
    text = path.read_text()
    assert text.startswith(f"#:schema {FILE}\n")
    assert not list(validator.iter_errors(tomllib.loads(text)))


def test_every_key_is_explained(validator):
    schema = validator.schema
    tables = [schema, *schema["$defs"].values(), schema["properties"]["fixed"], schema["properties"]["axes"]]
    for table in tables:
        for key, entry in table["properties"].items():
            assert entry["description"], key
    fixed, axes = (list(schema["properties"][name]["properties"]) for name in ("fixed", "axes"))
    assert fixed == [*axes, "similar", "bodies", "bulk_stress_body"]
    listed = call("list", "--parameters").output
    assert {*re.findall(r"^  (\w+)  ", listed, re.MULTILINE)} >= {*parameters(schema)}
    sizes = ["young_modulus", "radius", "depth", "normal_force", "contact_length", "bulk_stress_ratio"]
    assert axes == [*parameters(schema), *sizes, "body"]


def test_three_mistakes(validator):
    editor = {
        (".".join(map(str, error.absolute_path)), error.validator): error.message
        for error in validator.iter_errors(tomllib.loads(THREE_MISTAKES))
    }
    assert len(editor) == 3
    assert "'frictoin' was unexpected" in editor["fixed", "additionalProperties"]
    assert "0.7 is greater than the maximum of 0.5" in editor["fixed.poisson_ratio", "maximum"]
    assert ("axes.phase", "anyOf") in editor
    assert str(refused("", Study.from_text, THREE_MISTAKES, "three.toml")).splitlines() == [
        "three.toml: axes.phase.num: found nothing; allowed: a whole number",
        "three.toml: axes.phase.number: found unknown key 'number'; allowed: "
        "did you mean num? known: start, stop, num, spacing, also",
        "three.toml: fixed.frictoin: found unknown parameter 'frictoin'; allowed: "
        "did you mean friction? list all: swtstudy list --parameters",
        "three.toml: fixed.poisson_ratio: found 0.7 (out of range); allowed: a number in [0, 0.5]",
    ]


@pytest.mark.parametrize(
    "line", ["wavelength = 0", "frequency_ratio = 65", "friction = true", "friction = [0.1]"]
)
def test_the_editor_refuses_what_the_study_refuses(line, validator):
    text = f'title = "t"\n[fixed]\n{line}\n'
    assert list(validator.iter_errors(tomllib.loads(text)))
    refused("", Study.from_text, text)
