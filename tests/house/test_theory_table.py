"""The last table of docs/theory.md leads from symbols to code: its files exist and mention its identifiers."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADER = "| symbol | equation | identifier | file |"


def faults(theory, source):
    """What is wrong with the table in the text `theory`, for files below `source`."""
    if HEADER not in theory:
        return ["the table is missing"]
    found = []
    for row in theory.split(HEADER)[1].splitlines()[2:]:
        cells = row.strip().strip("|").split("|")
        if len(cells) < 4:
            continue
        identifiers, files = (re.findall(r"`([^`]+)`", cell) for cell in cells[-2:])
        found += [f"{name} does not exist" for name in files if not (source / name).is_file()]
        texts = [f for name in files for f in {source / name, (source / name).with_suffix(".hpp")} if f.is_file()]
        text = "\n".join(f.read_text() for f in texts)
        words = [word for identifier in identifiers for word in identifier.split("::")]
        found += [f"{word} is not in {', '.join(files)}" for word in words if not re.search(rf"\b{word}\b", text)]
    return found


class TheoryTable(unittest.TestCase):
    def test_names_what_exists(self):
        self.assertEqual(faults((ROOT / "docs" / "theory.md").read_text(), ROOT / "src" / "tessera"), [])

    def test_can_fail(self):
        source = ROOT / "src" / "tessera"
        row = "\n|---|---|---|---|\n| $F$ | 1 | `{}` | `{}` |\n"
        self.assertEqual(faults("", source), ["the table is missing"])
        self.assertEqual(faults(HEADER + row.format("Vec3", "base/vec3.hpp"), source), [])
        self.assertEqual(len(faults(HEADER + row.format("Vec4", "base/vec3.hpp"), source)), 1)
        self.assertEqual(faults(HEADER + row.format("Vec3", "base/vec9.hpp"), source)[0], "base/vec9.hpp does not exist")


if __name__ == "__main__":
    unittest.main()
