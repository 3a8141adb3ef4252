"""Audits DXF files by ezdxf: reads each, and wants no error and no fix; prints how many entities there are.

Usage: dxf_audit.py FILE...
"""

import sys
from collections import Counter

import ezdxf

failed = 0
for path in sys.argv[1:]:
    document = ezdxf.readfile(path)
    auditor = document.audit()
    found = Counter(entity.dxftype() for entity in document.modelspace())
    words = ", ".join(f"{count} {kind}" for kind, count in sorted(found.items())) or "nothing"
    print(f"{path}: {words}; {len(auditor.errors)} errors, {len(auditor.fixes)} fixes")
    for problem in [*auditor.errors, *auditor.fixes]:
        print(f"  {problem.message}")
    failed += bool(auditor.errors or auditor.fixes)
    if document.dxfversion != "AC1015" or document.units != ezdxf.units.MM:
        print("  it is no R2000 file in millimetres")
        failed += 1
sys.exit(failed > 0)
