"""The public items of a library crate, one a line, from rustdoc's JSON: `public_api.py CRATE.json`."""

import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    CRATE = json.load(file)
INDEX = CRATE["index"]
LINES = set()
SEEN = set()


def args(given):
    """Generic arguments behind a name."""
    if not given:
        return ""
    if "parenthesized" in given:
        inner = given["parenthesized"]
        out = inner.get("output")
        return f"({', '.join(map(typ, inner['inputs']))})" + (f" -> {typ(out)}" if out else "")
    parts = []
    for arg in given["angle_bracketed"]["args"]:
        kind, value = next(iter(arg.items())) if isinstance(arg, dict) else ("infer", "_")
        parts.append(typ(value) if kind == "type" else value["expr"] if kind == "const" else str(value))
    for equal in given["angle_bracketed"]["constraints"]:
        binding = equal["binding"]
        if "equality" in binding:
            term = binding["equality"]
            parts.append(f"{equal['name']} = {typ(term['type']) if 'type' in term else term['constant']['expr']}")
        else:
            parts.append(f"{equal['name']}: {bounds(binding['constraint'])}")
    return f"<{', '.join(parts)}>" if parts else ""


def bound(one):
    if "trait_bound" in one:
        inner = one["trait_bound"]
        mark = {"maybe": "?", "maybe_const": "~const "}.get(inner["modifier"], "")
        return mark + name(inner["trait"])
    return one.get("outlives") or "use<..>"


def bounds(all_of_them):
    return " + ".join(map(bound, all_of_them))


def name(path):
    """The last part of a path, with its arguments."""
    return path["path"].rsplit("::", 1)[-1] + args(path.get("args"))


def typ(of):
    kind, inner = next(iter(of.items())) if isinstance(of, dict) else (of, None)
    if kind == "resolved_path":
        return name(inner)
    if kind in ("generic", "primitive"):
        return inner
    if kind == "tuple":
        return f"({', '.join(map(typ, inner))})"
    if kind == "slice":
        return f"[{typ(inner)}]"
    if kind == "array":
        return f"[{typ(inner['type'])}; {inner['len']}]"
    if kind == "borrowed_ref":
        life = f"{inner['lifetime']} " if inner["lifetime"] else ""
        return f"&{life}{'mut ' if inner['is_mutable'] else ''}{typ(inner['type'])}"
    if kind == "raw_pointer":
        return f"*{'mut' if inner['is_mutable'] else 'const'} {typ(inner['type'])}"
    if kind == "impl_trait":
        return f"impl {bounds(inner)}"
    if kind == "dyn_trait":
        life = f" + {inner['lifetime']}" if inner["lifetime"] else ""
        return "dyn " + " + ".join(name(t["trait"]) for t in inner["traits"]) + life
    if kind == "qualified_path":
        of_trait = inner.get("trait")
        own = typ(inner["self_type"])
        return f"<{own} as {name(of_trait)}>::{inner['name']}" if of_trait else f"{own}::{inner['name']}"
    if kind == "function_pointer":
        return "fn" + signature(inner["sig"])
    raise SystemExit(f"public_api.py: a type of unknown kind {kind!r}")


def signature(sig):
    inputs = ", ".join(f"{own}: {typ(of)}" for own, of in sig["inputs"])
    return f"({inputs})" + (f" -> {typ(sig['output'])}" if sig["output"] else "")


def generics(of):
    parts = []
    for param in of["params"]:
        kind, inner = next(iter(param["kind"].items()))
        if kind == "type" and inner["is_synthetic"]:
            continue
        limits = f": {bounds(inner['bounds'])}" if kind == "type" and inner["bounds"] else ""
        default = inner.get("default") if kind == "type" else None
        default = f" = {typ(default)}" if default else ""
        parts.append(("const " if kind == "const" else "") + param["name"] + limits + default)
    where = []
    for one in of["where_predicates"]:
        if "bound_predicate" in one:
            inner = one["bound_predicate"]
            where.append(f"{typ(inner['type'])}: {bounds(inner['bounds'])}")
    return f"<{', '.join(parts)}>" if parts else "", f" where {', '.join(where)}" if where else ""


def function(path, item):
    inner = item["inner"]["function"]
    before, where = generics(inner["generics"])
    marks = "".join(f"{m} " for m in ("const", "unsafe", "async") if inner["header"][f"is_{m}"])
    LINES.add(f"{marks}fn {path}{before}{signature(inner['sig'])}{where}")


def implementations(path, ids):
    for one in ids:
        inner = INDEX[str(one)]["inner"]["impl"]
        if inner["is_synthetic"] or inner["blanket_impl"]:
            continue
        before, where = generics(inner["generics"])
        if inner["trait"] and inner["trait"]["path"].endswith("StructuralPartialEq"):
            continue  # the compiler's own
        if inner["trait"]:
            _, *given = typ(inner["for"]).split("<", 1)
            LINES.add(f"impl{before} {name(inner['trait'])} for {'<'.join([path, *given])}{where}")
        else:
            for member in inner["items"]:
                visit(INDEX[str(member)], path)


def fields(path, ids):
    for one in ids:
        item = INDEX.get(str(one)) if one is not None else None
        if item and item["visibility"] in ("public", "default"):
            LINES.add(f"field {path}::{item['name']}: {typ(item['inner']['struct_field'])}")


def marks(item):
    """What attributes say that binds those who use it."""
    known = [a if isinstance(a, str) else next(iter(a)) for a in item["attrs"]]
    return "".join(f" #[{a}]" for a in ("non_exhaustive", "must_use") if a in known)


def record(kind, path, item, inner):
    before, where = generics(inner["generics"])
    LINES.add(f"{kind} {path}{before}{where}{marks(item)}")
    shape = inner.get("kind")
    if isinstance(shape, dict) and "plain" in shape:
        fields(path, shape["plain"]["fields"])
        if shape["plain"]["has_stripped_fields"]:
            LINES.add(f"field {path}::(private)")
    elif isinstance(shape, dict):
        fields(path, shape["tuple"])
    implementations(path, inner["impls"])


def variants(path, ids):
    for one in ids:
        item = INDEX[str(one)]
        own = f"{path}::{item['name']}"
        LINES.add(f"variant {own}{marks(item)}")
        shape = item["inner"]["variant"]["kind"]
        if isinstance(shape, dict):
            fields(own, shape["struct"]["fields"] if "struct" in shape else shape["tuple"])


def visit(item, parent, renamed=None):
    """Notes an item under the path by which it is reached."""
    if item["visibility"] not in ("public", "default"):
        return
    kind, inner = next(iter(item["inner"].items()))
    if kind == "use":
        target = INDEX.get(str(inner["id"]))
        if target is None:
            LINES.add(f"use {parent}::{inner['name']} = {inner['source']}")
        elif inner["is_glob"]:
            for member in next(iter(target["inner"].values())).get("items", []):
                visit(INDEX[str(member)], parent)
        else:
            visit({**target, "visibility": "public"}, parent, inner["name"])
        return
    path = f"{parent}::{renamed or item['name']}" if parent else item["name"]
    if (path, kind) in SEEN and kind == "module":
        return
    SEEN.add((path, kind))
    if kind == "module":
        LINES.add(f"mod {path}")
        for member in inner["items"]:
            visit(INDEX[str(member)], path)
    elif kind == "function":
        function(path, item)
    elif kind in ("struct", "union"):
        record(kind, path, item, inner)
    elif kind == "enum":
        record(kind, path, item, inner)
        variants(path, inner["variants"])
    elif kind == "trait":
        before, where = generics(inner["generics"])
        above = f": {bounds(inner['bounds'])}" if inner["bounds"] else ""
        LINES.add(f"trait {path}{before}{above}{where}")
        for member in inner["items"]:
            own = INDEX[str(member)]
            body = next(iter(own["inner"].values()))
            if isinstance(body, dict) and body.get("has_body"):
                LINES.add(f"provided {path}::{own['name']}")
            visit(own, path)
    elif kind == "type_alias":
        LINES.add(f"type {path} = {typ(inner['type'])}")
    elif kind in ("constant", "static", "assoc_const"):
        LINES.add(f"const {path}: {typ(inner['type'])}")
    elif kind == "assoc_type":
        LINES.add(f"type {path}: {bounds(inner['bounds'])}")
    else:
        LINES.add(f"{kind} {path}")


visit({**INDEX[str(CRATE["root"])], "visibility": "public"}, "")
print("\n".join(sorted(LINES)))
