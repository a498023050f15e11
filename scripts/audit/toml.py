"""Scenes as dictionaries, written as TOML."""


def value(x) -> str:
    if isinstance(x, bool):
        return "true" if x else "false"
    if isinstance(x, str):
        return '"' + x + '"'
    if isinstance(x, (list, tuple)):
        return "[" + ", ".join(value(each) for each in x) + "]"
    if isinstance(x, dict):
        return "{ " + ", ".join(f"{key} = {value(each)}" for key, each in x.items()) + " }"
    return repr(x)


def lines_of(heading: str, table: dict) -> list[str]:
    return [f"[{heading}]"] + [f"{key} = {value(each)}" for key, each in table.items()] + [""]


# Tables of the scenario that are not lists of things by name.
SINGLE = {"time", "record", "damping", "integrator", "initial"}


def text(scene: dict) -> str:
    """The scene as a scenario file: `title`, then tables, things by name as `[kind.name]`."""
    out = [f'title = "{scene["title"]}"', ""]
    for kind, content in scene.items():
        if kind == "title":
            continue
        if kind in SINGLE:
            out += lines_of(kind, content)
        else:
            for name, table in content.items():
                out += lines_of(f"{kind}.{name}", table)
    return "\n".join(out)
