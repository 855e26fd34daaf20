"""What is inside an archive, as SPDX 2.3: rainref, the libraries that are linked into it, and the runtime of the compiler.

bill_of_materials.py NAME VERSION SOURCES: SOURCES holds the Debian source packages that scripts/libraries.sh unpacked (their .dsc files)."""

import json
import re
import subprocess
import sys
from pathlib import Path

# The licences that Debian's copyright files state for what is linked.
LICENCES = {"highway": "Apache-2.0", "fmtlib": "MIT", "xxhash": "BSD-2-Clause", "zlib": "Zlib", "libpng1.6": "libpng-2.0", "imath": "BSD-3-Clause",
            "openexr": "BSD-3-Clause", "libjpeg-turbo": "BSD-3-Clause AND IJG", "sqlite3": "blessing", "cpp-httplib": "MIT"}
# Headers alone, from the machine's own packages.
HEADERS = {"libglm-dev": "MIT", "nlohmann-json3-dev": "MIT", "libcli11-dev": "BSD-3-Clause", "libtomlplusplus-dev": "MIT"}


def package(name: str, version: str, licence: str, where: str) -> dict[str, object]:
    return {"SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name), "name": name, "versionInfo": version, "downloadLocation": where,
            "filesAnalyzed": False, "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION"}


def installed(name: str) -> str:
    return subprocess.run(["dpkg-query", "-W", "-f=${Version}", name], check=True, capture_output=True, text=True).stdout


def main() -> None:
    archive, version, sources = sys.argv[1:]
    packages = [package("rainref", version, "Apache-2.0", "NOASSERTION")]
    for description in sorted(Path(sources).glob("*.dsc")):
        fields = dict(re.findall(r"^(Source|Version): (.*)$", description.read_text(), re.M))
        name = fields["Source"]
        if name in LICENCES:
            packages.append(package(name, fields["Version"], LICENCES[name], f"https://sources.debian.org/src/{name}/{fields['Version']}/"))
    missing = LICENCES.keys() - {p["name"] for p in packages}
    if missing:
        sys.exit(f"{sources} lacks {', '.join(sorted(missing))}")
    packages += [package(name, installed(name), licence, f"https://packages.debian.org/bookworm/{name}") for name, licence in HEADERS.items()]
    packages.append(package("gcc-runtime", installed("gcc-12-base"), "GPL-3.0-only WITH GCC-exception-3.1", "https://sources.debian.org/src/gcc-12/"))
    created = subprocess.run(["git", "log", "-1", "--date=format-local:%Y-%m-%dT%H:%M:%SZ", "--format=%cd"], check=True, capture_output=True, text=True,
                             env={"TZ": "UTC", "PATH": "/usr/bin:/bin"}).stdout.strip()
    print(json.dumps({
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": archive,
        "documentNamespace": f"https://rainref.invalid/{archive}", "creationInfo": {"created": created, "creators": ["Tool: scripts/archives"]},
        "packages": packages,
        "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-rainref"}] +
                         [{"spdxElementId": "SPDXRef-rainref", "relationshipType": "STATIC_LINK", "relatedSpdxElement": p["SPDXID"]}
                          for p in packages[1:]]}, indent=1))


if __name__ == "__main__":
    main()
