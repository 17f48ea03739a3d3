#!/usr/bin/env bash
# Tries a Debian package where nothing else is: tools/try_package.sh [PACKAGE.deb] [FOLDER]
#
# Debootstraps a minimal Debian 12 in FOLDER (made, and removed at the end; without: a temporary one), with this machine's own
# sources of packages, installs the package by apt, runs a scene, measures, draws and shows it, imports it in Python, reads its
# page of the manual, and purges it: then no file is left that was not there before, but those of the packages that it asked for.
# Needs root, debootstrap and some 900 MB.
set -euo pipefail

fail() {
  echo "try_package.sh: $*" >&2
  exit 1
}

((EUID == 0)) || fail "a system of its own is made by root only."
command -v debootstrap >/dev/null || fail "debootstrap is missing: apt install debootstrap."
package=${1:-}
if [[ -z $package ]]; then
  packages=("$(dirname "$0")"/../build/package/skein_*.deb)
  package=${packages[0]}
fi
[[ -f $package ]] || fail "there is no package '$package': tools/package.sh makes one."
root=${2:-$(mktemp -d)/system}
[[ ! -e $root ]] || fail "'$root' is there already."
mkdir -p "$root"

clean_up() {
  umount -l "$root/dev" "$root/proc" 2>/dev/null || true
  mountpoint -q "$root/dev" || mountpoint -q "$root/proc" || rm -rf "$root"
}
trap clean_up EXIT

# From where this machine's apt has Debian 12 itself.
# shellcheck disable=SC2016 # apt expands REPO_URI
mirror=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Codename: bookworm' |
  sed -n 1p)}
[[ -n $mirror ]] || fail "apt's lists have no Debian 12: run 'apt-get update', or set DEBIAN_MIRROR."

echo "A bare Debian 12 in $root"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 ||
  fail "debootstrap failed; its output is in $root.log"
rm "$root.log"
for part in apt/sources.list apt/sources.list.d apt/apt.conf.d apt/trusted.gpg.d resolv.conf hosts ssl/certs; do
  if [[ -e /etc/$part ]]; then
    mkdir -p "$root/etc/$(dirname "$part")"
    cp -rL "/etc/$part" "$root/etc/$(dirname "$part")/"
  fi
done
# A bare system keeps pages of the manual out if it is a container's; this one is a machine's.
rm -f "$root/etc/dpkg/dpkg.cfg.d/docker" "$root/etc/apt/apt.conf.d"/docker-*
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
cp "$package" "$root/root/skein.deb"

inside() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  $(env | grep -i '_proxy=' || true) chroot "$root" bash -euo pipefail -c "$1"; }
list_files() { inside 'find / -xdev \( -path /proc -o -path /dev -o -path /root \) -prune -o -print | sort'; }

inside 'apt-get update -qq'
echo "Installing"
inside 'cd /root && apt-get install -qq -y -o Dpkg::Options::=--force-unsafe-io ./skein.deb man-db >install.log 2>&1 || { tail -n 20 install.log >&2; exit 1; }'
inside 'dpkg -L skein | while read -r path; do [ -d "$path" ] || echo "$path"; done' >"$root/root/of_the_package"
[[ -s $root/root/of_the_package ]] || fail "the package holds no file."

echo "Using it"
inside 'cd /root
  skein new --list >/dev/null
  skein new lagrone2019_L0139 -o scene.toml
  skein run scene.toml -o run --set fiber.model=chain -q
  skein run scene.toml -o tube --set time.end=0.5 -q
  skein verify run
  skein analyze run | head -n 2
  skein plot run
  skein view run
  skein report run
  test -s run/plots/shapes.png -a -s run/plots/view.html -a -s run/plots/report.html
  python3 -c "import skein; run = skein.run({\"fiber\": {\"model\": \"chain\"}, \"time\": {\"end\": 1.0}}); print(skein.__version__, run)"
  python3 -c "import skein; print(skein.mobility([[0, 0, 0]], [[1, 0, 0]], 0.1).method)"
  man skein | head -n 5
  bash -c "source /usr/share/bash-completion/completions/skein && complete -p skein"'

echo "Purging it"
list_files >"$root/root/with"
inside 'apt-get purge -qq -y skein >/root/purge.log 2>&1 || { tail -n 20 /root/purge.log >&2; exit 1; }'
list_files >"$root/root/without"
left=$(comm -12 <(sort "$root/root/of_the_package") "$root/root/without")
[[ -z $left ]] || fail "the package's own files are left behind: $left"
left=$(grep -i skein "$root/root/without" | grep -v '^/var/cache/man/' || true)  # which man makes of the pages that it has shown
[[ -z $left ]] || fail "left behind: $left"
added=$(comm -13 "$root/root/with" "$root/root/without" | grep -v '^/var/\(lib/dpkg\|lib/apt\|log\|cache\)' || true)
[[ -z $added ]] || fail "purging adds files: $added"
gone=$(comm -23 "$root/root/with" "$root/root/without" | wc -l)
echo "$(basename "$package"): installed, used and purged; $(wc -l <"$root/root/of_the_package") files, $gone paths gone, nothing left"
