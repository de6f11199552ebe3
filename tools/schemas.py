"""Write the JSON Schemas of paper.yaml and claims.yaml, for editors that complete and check while one types."""

import json
from pathlib import Path

from recontrol.claims import schema
from recontrol.paper import PaperFile


def documents():
    """File name -> schema text, generated from the models that validate the files."""
    schemas = {"paper": PaperFile.model_json_schema(), "claims": schema.json_schema()}
    return {f"schemas/{name}.schema.json": json.dumps(content, indent=1) + "\n" for name, content in schemas.items()}


if __name__ == "__main__":
    for name, text in documents().items():
        Path(name).parent.mkdir(exist_ok=True)
        Path(name).write_text(text)
        print(name)
