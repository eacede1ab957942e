"""fresh_playground.py ROOT: web/built/playground.html is made of the sources as they stand. The page holds the SHA-256 of each file that
it was made of (addons/playground/wasm/build.mjs); no compiler is needed to compare them."""
import base64
import gzip
import hashlib
import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
RENEW = "renew it by addons/playground/wasm/build.sh web/built (needs emscripten, minutes)"
page = (root / "web" / "built" / "playground.html").read_text()
part = re.search(r'<script type="text/plain" id="sources">([^<]*)</script>', page)
if part is None:
    sys.exit(f"web/built/playground.html does not tell what it was made of; {RENEW}")
told = dict(reversed(line.split("  ", 1)) for line in gzip.decompress(base64.b64decode(part[1])).decode().splitlines())
if not any(name.startswith("spoolflow/sensor/") for name in told) or "web/src/playground/playground.ts" not in told:
    sys.exit(f"web/built/playground.html tells of {len(told)} files, among them no sensor or no page; {RENEW}")


def differs(name, sum):
    file = root / name
    return not file.exists() or hashlib.sha256(file.read_bytes()).hexdigest() != sum


changed = [name for name, sum in told.items() if differs(name, sum)]
if changed:
    sys.exit(f"web/built/playground.html is older than {len(changed)} of its {len(told)} sources, such as {', '.join(changed[:5])}; {RENEW}")
print(f"web/built/playground.html is of the {len(told)} sources as they stand")
