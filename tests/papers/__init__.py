from __future__ import annotations

import base64
import json
import re
import zlib
from typing import Any


def unpacked(page: str) -> dict[str, Any]:
    """The data of a page, the positions one by one."""
    packed = re.search(r'<script type="text/plain" id="positions">(.*?)</script>', page, re.DOTALL)
    assert packed is not None
    data = json.loads(zlib.decompress(base64.b64decode(packed[1])))
    rows = {"figures", "steps"}
    data["positions"] = [
        {k: [row[i] for row in v if row[i]] if k in rows else v[i] for k, v in data["positions"].items()}
        for i in range(len(data["positions"]["at"]))
    ]
    return data
