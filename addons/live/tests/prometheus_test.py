#!/usr/bin/python3
"""prometheus_test.py COMMAND EXAMPLES ADDON: metrics, alert rules and dashboard of `spoolflow live` by Prometheus' own checker:
/metrics is clean, each rule fires on what it is for alone, and every metric that a rule or a panel names is served."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from served import Live  # noqa: E402

command, examples, addon = map(os.path.abspath, sys.argv[1:4])
if shutil.which("promtool") is None:
    print("SKIPPED: promtool is not installed (Debian: prometheus)")
    sys.exit(77)
folder = tempfile.mkdtemp(prefix="spoolflow-prometheus-")


def checked(*arguments, **options):
    done = subprocess.run(["promtool", *arguments], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def metrics_in(expression):
    return set(re.findall(r"\bspoolflow_[a-z0-9_]+", expression))


try:
    shutil.copy(os.path.join(examples, "live", "size_6.json"), os.path.join(folder, "model.json"))
    with open(os.path.join(folder, "site.toml"), "w", encoding="utf-8") as file:
        file.write('[page]\nlisten = "127.0.0.1:0"\n[store]\nfile = "site.sqlite"\n[can]\nlog = "bus.log"\nauxiliary_valve = { a = 3 }\n'
                   '[sources]\nudp = "127.0.0.1:0"\n'
                   '[[valve]]\nid = "a"\nmodel = "model.json"\nsource = { kind = "rig", seed = 1 }\n'
                   '[[valve]]\nid = "b"\nmodel = "model.json"\nsource = { kind = "udp" }\n')
    with Live(command, folder, "site.toml") as live:
        status, _, metrics = live.ask("/metrics")
    assert status == 200
    said = checked("check", "metrics", input=metrics)
    assert said == "", said
    served = set(re.findall(r"^# TYPE (\S+)", metrics, re.MULTILINE))

    rules = os.path.join(addon, "prometheus", "alerts.yml")
    said = checked("check", "rules", rules)
    with open(rules, encoding="utf-8") as file:
        text = file.read()
    alerts = re.findall(r"- alert: (\S+)", text)
    assert f"{len(alerts)} rules found" in said, said
    assert metrics_in(text) <= served, metrics_in(text) - served
    for part in re.split(r"- alert: ", text)[1:]:
        assert all(f"{key}: " in part for key in ("severity", "summary", "description")), part
    tests = os.path.join(addon, "prometheus", "alerts_test.yml")
    checked("test", "rules", tests)
    with open(tests, encoding="utf-8") as file:
        tried = set(re.findall(r'alertname="(\w+)"', file.read()))
    assert tried == set(alerts), tried ^ set(alerts)

    with open(os.path.join(addon, "grafana", "spoolflow_live.json"), encoding="utf-8") as file:
        dashboard = json.load(file)
    panels = dashboard["panels"]
    assert len({panel["id"] for panel in panels}) == len(panels)
    places = [(x, y) for panel in panels for at in [panel["gridPos"]]
              for x in range(at["x"], at["x"] + at["w"]) for y in range(at["y"], at["y"] + at["h"])]
    assert len(places) == len(set(places)) and all(0 <= x < 24 for x, _ in places), "panels overlap"
    expressions = [target["expr"] for panel in panels for target in panel["targets"]]
    for expression in expressions:
        assert metrics_in(expression) and metrics_in(expression) <= served, expression
    asked = [expression.replace('"$valve"', '".*"').replace("$__rate_interval", "1m") for expression in expressions]
    with open(os.path.join(folder, "panels.yml"), "w", encoding="utf-8") as file:
        json.dump({"groups": [{"name": "panels", "rules": [{"record": f"panel:{k}", "expr": expression}
                                                           for k, expression in enumerate(asked)]}]}, file)
    checked("check", "rules", os.path.join(folder, "panels.yml"))  # which reads each as PromQL
    print(f"{len(served)} metrics, {len(alerts)} alerts, {len(panels)} panels")
finally:
    shutil.rmtree(folder)
