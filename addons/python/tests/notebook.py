"""Runs a notebook's code cells in order with the standard library alone; with `--write`, stores what they gave.

    PYTHONPATH=build/release/python /usr/bin/python3 addons/python/tests/notebook.py NOTEBOOK.ipynb [--write]

What a cell prints, the value of its last expression and, where Matplotlib is installed, its figures are its outputs.
"""
import ast
import base64
import contextlib
import io
import json
import os
import sys

try:
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot
except ImportError:
    pyplot = None


def lines(text):
    return text.splitlines(keepends=True)


def figures():
    """Those that the cell drew, as PNG."""
    out = []
    for number in pyplot.get_fignums() if pyplot else []:
        picture = io.BytesIO()
        pyplot.figure(number).savefig(picture, format="png", dpi=72, bbox_inches="tight", metadata={"Software": None})
        out.append({"output_type": "display_data", "metadata": {},
                    "data": {"image/png": base64.b64encode(picture.getvalue()).decode() + "\n",
                             "text/plain": ["<Figure>"]}})
    if pyplot:
        pyplot.close("all")
    return out


def run_cell(source, names, number):
    """The cell's outputs."""
    tree = ast.parse(source)
    last = ast.Expression(tree.body.pop().value) if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    if source.rstrip().endswith(";"):
        tree.body, last = [*tree.body, *([ast.Expr(last.body)] if last else [])], None
    printed, value = io.StringIO(), None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, f"cell {number}", "exec"), names)
        if last is not None:
            value = eval(compile(last, f"cell {number}", "eval"), names)
    out = []
    if printed.getvalue():
        out.append({"output_type": "stream", "name": "stdout", "text": lines(printed.getvalue())})
    if value is not None:
        out.append({"output_type": "execute_result", "execution_count": number, "metadata": {},
                    "data": {"text/plain": lines(repr(value))}})
    return out + figures()


def run(notebook):
    """Its outputs, a list for each code cell."""
    names = {"__name__": "__main__"}
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    return [run_cell("".join(cell["source"]), names, number) for number, cell in enumerate(cells, 1)]


def text_of(outputs):
    """What of a cell's outputs is text."""
    return "".join("".join(each.get("text", [])) + "".join(each.get("data", {}).get("text/plain", []))
                   for each in outputs if each["output_type"] != "display_data")


def main(path, write=False):
    with open(path, encoding="utf-8") as file:
        notebook = json.load(file)
    before = os.getcwd()
    os.chdir(os.path.dirname(os.path.abspath(path)))
    outputs = run(notebook)
    os.chdir(before)
    for number, (cell, given) in enumerate(
            zip((cell for cell in notebook["cells"] if cell["cell_type"] == "code"), outputs), 1):
        cell["outputs"], cell["execution_count"] = given, number
        print(text_of(given), end="")
    if write:
        with open(path, "w", encoding="utf-8") as file:
            json.dump(notebook, file, indent=1, ensure_ascii=False)
            file.write("\n")


if __name__ == "__main__":
    main(sys.argv[1], "--write" in sys.argv[2:])
