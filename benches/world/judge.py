"""The rules: what of an answer is right, and what is a false name. README.md says why."""

# A planted effect is asked for from here on: standard errors of the optimal fit, the others free; and evidence with
# the noise refitted, of which looking at some hundred places costs ten and two parameters of a thousand rows fourteen.
ASKED, ASKED_EVIDENCE = 7.9, 30.0


def judge(truth, answer):
    """(right, false names, remark)."""
    names = [effect["effect"] for effect in answer["effects"]]
    verdict = answer["verdict"]
    false = false_names(truth, answer) if verdict == "explained" else []
    if verdict == "failed":
        return False, [], answer["error"][:160]
    right, remark = RULES[truth["expect"]](truth, answer, verdict, set(names))
    return right and not false, false, remark


def false_names(truth, answer):
    """Every named effect that is not planted, or is planted at another order, harmonic or frequency."""
    out = []
    for effect in answer["effects"]:
        same = [one for one in truth["planted"] if one["effect"] == effect["effect"]]
        if effect["effect"] in truth["allowed"] and not same:
            continue
        if not any(same_place(one["parameters"], effect["parameters"]) for one in same):
            out.append(effect["effect"])
    return out


def same_place(planted, told):
    """Equal where the shape decides who is meant: order, harmonic, frequency."""
    for key, tolerance in (("order", 2e-2), ("harmonic", 1e-6), ("frequency", 5e-3)):
        value = parameter(told, key)
        if key not in planted or value is None:
            continue
        if abs(value["value"] - planted[key]) > tolerance * max(1, planted[key]):
            return False
    return True


def parameter(told, key):
    """The parameter of this name; the program appends the unit."""
    if key in told:
        return told[key]
    found = [value for name, value in told.items() if name.startswith(key + "_") and name[len(key) + 1:] in UNITS]
    return found[0] if found else None


UNITS = {"um", "arcsec", "deg", "mm", "s", "hz", "m", "um_per_m", "um_per_m2", "um_per_m_2", "um_per_m3", "um_per_h",
         "arcsec_per_h", "ppm_per_h", "ppm", "um_per_n", "mrad"}


def asked(truth):
    return [one for one in truth["planted"] if one["level"] >= ASKED and one["evidence"] >= ASKED_EVIDENCE]


def nothing(truth, answer, verdict, names):
    return verdict == "nothing-missing", verdict


def named(truth, answer, verdict, names):
    wanted = asked(truth)
    if verdict == "doubtful-input":
        return False, "sound data doubted"
    if not wanted:
        return True, "too small to be asked for"
    missing = [one for one in wanted if not told(one, answer)]
    if not missing and verdict == "explained":
        return True, verdict
    if verdict == "ambiguous" and not any(one["alike"] for one in wanted):
        return False, "ambiguous where the data can tell"
    if verdict == "ambiguous" and all(one["alike"] and one["effect"] in answer["contenders"] for one in missing):
        return True, "ambiguous where the data cannot tell"
    return False, f"{verdict} without " + ", ".join(one["effect"] for one in missing)


def told(one, answer):
    return any(
        effect["effect"] == one["effect"] and same_place(one["parameters"], effect["parameters"])
        for effect in answer["effects"]
    )


def form(truth, answer, verdict, names):
    allowed = set(truth["allowed"])
    if verdict == "explained":
        whole = all(told(one, answer) for one in asked(truth) if not one["effect"].startswith("outside"))
        return names <= allowed and whole, verdict
    if verdict == "ambiguous":
        torn = any(set(one["alike"]) - allowed for one in truth["planted"]) or answer["contenders"] <= allowed
        return bool(torn and allowed & answer["contenders"]), verdict
    if verdict == "nothing-missing" and not asked(truth):
        return True, "too small to be asked for"
    return verdict == "unexplained", verdict


def outside(truth, answer, verdict, names):
    formula = verdict == "explained" and answer["proposals"] and names <= set(truth["allowed"])
    return verdict == "unexplained" or bool(formula), verdict


def doubt(truth, answer, verdict, names):
    if verdict == "refused":
        return any(word in answer["error"].lower() for word in truth["doubts"]), "refused: " + answer["error"][:120]
    text = str(answer["doubts"]).lower()
    return verdict == "doubtful-input" and any(word in text for word in truth["doubts"]), verdict


def setting(truth, answer, verdict, names):
    if verdict == "explained":
        return names == {"wrong-setting"}, verdict
    if verdict == "ambiguous":
        return "wrong-setting" in answer["contenders"], verdict
    return doubt(truth, answer, verdict, names)


def alias(truth, answer, verdict, names):
    """Resolved by two rates: the frequency itself, or a list of the possible ones that says so."""
    if verdict == "explained":
        return names == {"vibration"}, verdict
    return verdict == "ambiguous" and "vibration" in answer["contenders"], verdict


def unresolvable(truth, answer, verdict, names):
    return verdict in ("ambiguous", "unexplained"), verdict


def anything(truth, answer, verdict, names):
    return verdict in ("ambiguous", "unexplained", "explained"), verdict


def unresolved(truth, answer, verdict, names):
    return verdict in ("nothing-missing", "unexplained"), verdict


RULES = {"nothing": nothing, "named": named, "form": form, "outside": outside, "doubt": doubt, "setting": setting,
         "alias": alias, "unresolvable": unresolvable, "open": anything, "unresolved": unresolved}


def covered(truth, answer):
    """(effect, parameter, told, true, standard errors) of every parameter that has both."""
    out = []
    if answer["verdict"] != "explained":
        return out
    for effect in answer["effects"]:
        same = [one for one in truth["planted"] if one["effect"] == effect["effect"]
                and same_place(one["parameters"], effect["parameters"])]
        for key, true in (same[0]["parameters"].items() if same else ()):
            value = parameter(effect["parameters"], key)
            if value is None or not value.get("stderr"):
                continue
            gap = value["value"] - true
            if key.startswith("phase"):
                gap = (gap + 180) % 360 - 180
            out.append((effect["effect"], key, value["value"], true, gap / value["stderr"]))
    return out
