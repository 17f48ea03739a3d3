"""The Debian package, made of what was built: what it holds, asks for, and whether it runs from another place.

Called as check_package.py CPACK CONFIGURATION FOLDER. Needs dpkg-deb.
"""

import pathlib
import shutil
import subprocess
import sys


def call(*words):
    return subprocess.run([*map(str, words)], check=True, capture_output=True, text=True, timeout=300).stdout


def main(cpack, configuration, folder):
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    call(cpack, "--config", configuration, "-B", folder)
    (package,) = folder.glob("*.deb")

    fields = dict(line.split(": ", 1) for line in call("dpkg-deb", "--field", package).splitlines() if ": " in line)
    assert fields["Package"] == "skein", fields
    for needed in ("libc6", "libhdf5", "python3-h5py", "python3-matplotlib"):
        assert needed in fields["Depends"], f"{needed} is not in {fields['Depends']}"

    # What Python compiles goes with the package: postinst compiles it, prerm removes it.
    call("dpkg-deb", "-e", package, folder / "control")
    for script, does in (("postinst", "py3compile -p skein"), ("prerm", "py3clean -p skein")):
        path = folder / "control" / script
        assert path.stat().st_mode & 0o777 == 0o755 and does in path.read_text(), script
    assert "libjs-three" in fields["Recommends"], fields

    call("dpkg-deb", "-x", package, folder / "root")
    usr = folder / "root/usr"
    files = {str(path.relative_to(usr)) for path in usr.rglob("*") if path.is_file()}
    for expected in ("bin/skein", "share/man/man1/skein.1", "share/bash-completion/completions/skein",
                     "share/skein/configs/tumbling.toml", "share/skein/plots/plot_run.py"):
        assert expected in files, f"{expected} is not among {sorted(files)}"
    assert not [name for name in files if name.endswith((".a", ".hpp", ".cmake"))], "headers and libraries are not for it"
    assert [name for name in files if name.endswith("skein/__init__.py")], "there is no package for Python"

    # What it finds are its own files, not those it was built from.
    for path in (usr / "share/skein/configs").glob("*.toml"):
        if path.stem != "tumbling":
            path.unlink()
    listed = call(usr / "bin/skein", "new", "--list").splitlines()
    assert [line.split()[0] for line in listed] == ["tumbling"], listed
    print(f"{package.name}: {package.stat().st_size / 1e6:.1f} MB, {len(files)} files")


if __name__ == "__main__":
    main(*sys.argv[1:])
