"""Plots through gnuplot: a table of named data blocks and the commands that draw them."""

import subprocess

STYLE = """set terminal pngcairo size {width},{height} font 'Sans,11' linewidth 1.4 rounded
set output '{output}'
set border linecolor rgb '#444444'
set grid linecolor rgb '#dddddd' linetype 1
set key reverse Left samplen 2
set linetype 1 linecolor rgb '#1f5fa8'
set linetype 2 linecolor rgb '#c8401e'
set linetype 3 linecolor rgb '#2d8a4a'
set linetype 4 linecolor rgb '#8a5bb0'
set linetype 5 linecolor rgb '#b8860b'
set linetype 6 linecolor rgb '#5a5a5a'
"""


def block(name, rows):
    """A data block $name; None leaves a gap."""
    lines = [" ".join("nan" if v is None else f"{v:.9g}" for v in row) for row in rows]
    return f"${name} << EOD\n" + "\n".join(lines) + "\nEOD\n"


def plot(output, blocks, commands, size=(1000, 420)):
    """Draws into a PNG. blocks: name -> rows of numbers; commands: gnuplot text that plots $name."""
    text = STYLE.format(output=output, width=size[0], height=size[1])
    text += "".join(block(name, rows) for name, rows in blocks.items()) + commands + "\n"
    done = subprocess.run(["gnuplot"], input=text, text=True, capture_output=True)
    if done.returncode != 0:
        raise SystemExit(f"gnuplot: {done.stderr.strip()}")
