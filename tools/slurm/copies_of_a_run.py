#!/usr/bin/env python3
"""Many copies of the one motion of a run, as the shards of a larger run would have left them: to measure merging.
  mimicx adapt --policy data/synthetic/test/noisy/walk_1.npz --out one
  tools/slurm/copies_of_a_run.py one 10000 64 many      # 10,000 motions (links to the one) in 64 shards
  /usr/bin/time -v mimicx merge many
Knows by itself who does what (docs/cluster.md, "Who does what"): merge would call a motion of another shard missing.
"""
import copy
import json
import os
import sys


def place(name):
    h = 0xcbf29ce484222325
    for byte in name.encode():
        h = (h ^ byte) * 0x100000001b3 % 2**64
    for factor in (0xff51afd7ed558ccd, 0xc4ceb9fe1a85ec53):
        h = (h ^ h >> 33) * factor % 2**64
    return h ^ h >> 33, name.encode()


def copied(entry, name):
    copy_of_it = copy.deepcopy(entry)
    copy_of_it["files"] = {file.replace(entry["name"], name): sum for file, sum in entry["files"].items()}
    copy_of_it.update(name=name, input=f"in/{name}.npz", output=entry["output"].replace(entry["name"], name))
    return copy_of_it


def write(path, json_value):
    os.makedirs(os.path.dirname(path))
    with open(path, "w", encoding="utf-8") as file:
        json.dump(json_value, file, indent=1)


run, count, shards, out = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
with open(os.path.join(run, "manifest.json"), encoding="utf-8") as file:
    manifest = json.load(file)
entry = manifest["sequences"][0]
names = [f"clip_{i:06d}" for i in range(count)]
inputs = [{"name": name, "input": f"in/{name}.npz"} for name in names]
write(os.path.join(out, "shards", "run.json"), {"run": manifest["run"], "shards": shards, "inputs": inputs})
for file in entry["files"]:
    os.makedirs(os.path.join(out, os.path.dirname(file)), exist_ok=True)
    for name in names:
        os.link(os.path.join(run, file), os.path.join(out, file.replace(entry["name"], name)))
order = sorted(names, key=place)
if os.path.exists(os.path.join(run, "clusters.json")):
    os.link(os.path.join(run, "clusters.json"), os.path.join(out, "clusters.json"))
for shard in range(shards):
    width = max(3, len(str(shards)))
    write(os.path.join(out, "shards", f"{shard:0{width}d}-of-{shards:0{width}d}", "manifest.json"),
          {"run": manifest["run"], "sequences": [copied(entry, name) for name in sorted(order[shard::shards])]})
