"""Holds docs/stage.schema.json against the documents that tests/stage/stage_test.cpp gives to the reader."""
import json
import sys

import jsonschema

schema = json.load(open(sys.argv[1]))
documents = json.load(open(sys.argv[2]))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
wrong = [f"refused: {d}: {e.message}" for d in documents["good"] for e in validator.iter_errors(d)]
wrong += [f"accepted: {d}" for _, d in documents["bad"] if validator.is_valid(d)]
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
