"""Names whose numbers stand in tables of points: the kernel has them in the order of the studies."""

import json

from command import call

from swtstudy.kernel.criterion import NAMES


def test_the_kernel_and_the_schema_have_the_same_criteria_in_the_same_order() -> None:
    schema = json.loads(call("schema").output)
    assert schema["properties"]["fixed"]["properties"]["criterion"]["examples"] == list(NAMES)
