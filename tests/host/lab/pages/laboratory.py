"""Where the tests find the laboratory's modules, and tables made for a test."""

import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[4]
for _folder in ("lab", "lab/pages", "lab/labelled", "lab/recorded", "lab/target"):
    sys.path.insert(0, str(ROOT / _folder))


class Tables(tempfile.TemporaryDirectory):
    """with Tables(name=text) as folder: a folder that holds name.csv, as lab/data would."""

    def __init__(self, **texts: str):
        super().__init__()
        self.texts = texts

    def __enter__(self) -> pathlib.Path:
        folder = pathlib.Path(super().__enter__())
        for name, text in self.texts.items():
            (folder / f"{name}.csv").write_text(text)
        return folder
