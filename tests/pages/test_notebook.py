"""The notebook runs from the first cell to the last, and says what it is about."""

import pytest
from folders import ROOT, STUDIES

# The machinery around the kernel warns in its own ways.
pytestmark = pytest.mark.filterwarnings("ignore")

NOTEBOOK = STUDIES / "explore.ipynb"


def texts(notebook) -> dict[str, str]:
    """What the tagged cells print."""
    return {
        cell.metadata.tags[0]: "".join(output.get("text", "") for output in cell.outputs)
        for cell in notebook.cells
        if cell.cell_type == "code" and cell.metadata.get("tags")
    }


BAR = "application/vnd.jupyter.widget-view+json"


def printed(notebook) -> list[tuple[str, list[str]]]:
    """What every cell prints, in however many pieces it came, and shows as text: of a picture its size.

    Bars of progress, which are widgets, are left out.
    """
    return [
        (
            "".join(output.get("text", "") for output in cell.outputs),
            [
                output["data"].get("text/plain", "")
                for output in cell.outputs
                if "data" in output and BAR not in output["data"]
            ],
        )
        for cell in notebook.cells
        if cell.cell_type == "code"
    ]


def pictures(notebook) -> int:
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    return sum("image/png" in output.get("data", {}) for output in outputs)


@pytest.mark.pages
def test_the_notebook(monkeypatch):
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    committed = nbformat.read(NOTEBOOK, as_version=4)
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    nbclient.NotebookClient(
        notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(NOTEBOOK.parent)}}
    ).execute()
    found = texts(notebook)
    # The paper's section 4.2: the phase matters most at simple frequency ratios, here at 1/2.
    assert "a factor of 2.736" in found["phase-ratio"]
    assert float(found["new-curve"].split()[-1]) < 1.2
    assert "rounded punch: 0.54" in found["profiles"]
    # The last sentence of the paper: a normal oscillation can reduce the risk, if chosen properly.
    assert "best: s = 0.055 at 243°, -56 %" in found["best-load"]
    assert "worst: s = 0.226 at 31°, +79 %" in found["best-load"]
    assert "ψ = 150°: SWT = 0.49 MPa" in found["life"]
    assert pictures(notebook) == pictures(committed) == 5
    # The outputs that are committed are those of this code.
    assert printed(committed) == printed(notebook)
    assert NOTEBOOK.stat().st_size < 800_000
