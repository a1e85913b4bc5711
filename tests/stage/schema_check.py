"""schema_check.py SCHEMA DOCUMENTS SCENES_PROGRAM: the schema accepts and rejects what the loader does (the same table is
read by stage_test.cpp), and accepts every stage file that the demo generator writes."""
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

schema = json.loads(pathlib.Path(sys.argv[1]).read_text())
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
wrong = []
for case in json.loads(pathlib.Path(sys.argv[2]).read_text()):
    if validator.is_valid(case["document"]) != ("message" not in case):
        wrong.append(json.dumps(case["document"]))
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[3], folder], check=True, stdout=subprocess.DEVNULL)
    stages = sorted(pathlib.Path(folder).glob("*.stage.json"))
    if not stages:
        wrong.append("the generator wrote no stage file")
    for stage in stages:
        for error in validator.iter_errors(json.loads(stage.read_text())):
            wrong.append(f"{stage.name}: {error.message}")
print("\n".join(wrong) if wrong else f"{len(stages)} stage files of the generator are valid")
sys.exit(1 if wrong else 0)
