#!/usr/bin/env bash
# Makes the site of the pages in build/site: Sphinx reads them where they are, Doxygen the public headers, and the gallery is
# made of configs/, with what has not changed since left as it is. Every warning is an error.
#   tools/site.sh                       sets up, builds the program, runs the scenes (minutes), makes all pages
#   tools/site.sh --program FILE --python FOLDER --output FOLDER    of a program and a package that are there; no set-up
#   tools/site.sh --scenes none         a gallery without pictures; --scenes a,b runs these alone
set -euo pipefail
cd "$(dirname "$0")/.."

program='' python='' output=$PWD/build/site scenes=all
while (($#)); do
  case $1 in
    --program | --python | --output | --scenes)
      (($# > 1)) || {
        echo "site.sh: $1 needs a value." >&2
        exit 1
      }
      declare "${1#--}=$2"
      shift
      ;;
    *)
      echo "site.sh: unknown option '$1'; the head of the script lists them." >&2
      exit 1
      ;;
  esac
  shift
done
if [[ -z $program ]]; then
  SKEIN_SETUP_OPTIONS="--with-python --with-viewer --with-site" \
    tools/build.sh openmp --target=skein --target=skein_python
  program=$PWD/build/openmp/bin/skein python=$PWD/build/openmp/python
fi

katex=/usr/share/javascript/katex
for needed in sphinx-build doxygen "$katex/katex.min.js" /usr/share/javascript/three/build/three.min.js; do
  if ! command -v "$needed" >/dev/null && [[ ! -e $needed ]]; then
    echo "site.sh: $needed is missing: tools/setup.sh --with-site installs it." >&2
    exit 1
  fi
done

# Parts are made anew, but for the gallery's runs, which know what they were made of.
export SKEIN_SITE_ROOT=$PWD SKEIN_SITE_PARTS=$output/parts SKEIN_SITE_PROGRAM=$program SKEIN_SITE_PYTHON=$python
rm -rf "$output/parts" "$output/html"
mkdir -p "$output/parts"/{extra,static/katex}
cp -rL "$katex"/{katex.min.js,katex.min.css,fonts} "$katex/contrib/auto-render.js" "$output/parts/static/katex/"
doxygen tools/site/Doxyfile
python3 tools/site/make_gallery.py "$program" configs "$output/runs" "$output/parts" --scenes "$scenes"
sphinx-build -W --keep-going -q -j auto -d "$output/doctrees" -c tools/site . "$output/html"
cat >"$output/html/index.html" <<'HTML'
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>skein</title>
<meta http-equiv="refresh" content="0; url=docs/index.html"></head><body><a href="docs/index.html">skein</a></body></html>
HTML
echo "$output/html/index.html"
