#!/bin/sh
# ci/release.sh VERSION [--only PART,…] [--twice] [--walks NAME,…] [--work DIR] [--suite NAME]: the files of a release in DIR/VERSION (DIR:
# out/release), with SHA256SUMS: the source archive, and the parts of ci/release_parts.sh, made of a clean clone of what is committed. As
# root in a bare Debian root (debootstrap; SUITE: bookworm), else in a folder of its own with what this machine has.
#   --only    of source, core, addons, arm64, wheels, fmus, libraries, playground; without it all
#   --twice   makes all once more of another clone elsewhere, and fails where a byte differs
#   --walks   as root, installs the packages in a fresh root and runs these walks of docs/walks there (all that need no compiler);
#             none: installs them and asks the version
set -eu
root=$(dirname "$(dirname "$(readlink -f "$0")")")
version=${1:-}
[ "$version" ] && shift || { sed -n '2,9s/^# //p' "$0" >&2; exit 2; }
only=source,core,addons,arm64,wheels,fmus,libraries,playground walks=outputs,test_rig,flow_bench,whole_valve,a_thousand_valves,condition_monitoring
work=$root/out/release suite=bookworm twice=
while [ $# -gt 0 ]; do
  case "$1" in
    --twice) twice=yes && shift ;;
    --only) only=$2 && shift 2 ;;
    --walks) walks=$2 && shift 2 ;;
    --work) work=$2 && shift 2 ;;
    --suite) suite=$2 && shift 2 ;;
    *) echo "ci/release.sh: unknown '$1'" >&2; exit 2 ;;
  esac
done
fail() { echo "ci/release.sh: $*" >&2; exit "${status:-1}"; }
commit=$(git -C "$root" rev-parse HEAD)
stated=$(git -C "$root" show "$commit:CMakeLists.txt" | sed -n 's/^project(spoolflow VERSION \([0-9.]*\).*/\1/p')
[ "$version" = "$stated" ] || status=2 fail "the project is of version $stated: set it in CMakeLists.txt and commit, or ask for that"
git -C "$root" diff --quiet HEAD || echo "ci/release.sh: what is not committed is left out" >&2
parts=$(echo "$only" | tr ',' ' ')
built=$(echo " $parts " | sed 's/ source / /')
export SOURCE_DATE_EPOCH="$(git -C "$root" log -1 --format=%ct "$commit")"
work=$(mkdir -p "$work" && readlink -f "$work")
out=$work/$version

# A bare root, kept as an archive from the first call on.
bare() { # DIR
  if [ ! -e "$work/$suite.tar" ]; then
    echo "a bare root of $suite" >&2
    rm -rf "$work/made" && debootstrap --variant=minbase --include=ca-certificates "$suite" "$work/made" >"$work/debootstrap.log" || fail "see $work/debootstrap.log"
    rm -f "$work/made"/var/cache/apt/archives/*.deb
    tar -C "$work/made" -cf "$work/$suite.part" . && mv "$work/$suite.part" "$work/$suite.tar" && rm -rf "$work/made"
  fi
  rm -rf --one-file-system "$1" && mkdir -p "$1" && tar -C "$1" -xf "$work/$suite.tar"
  echo force-unsafe-io >"$1/etc/dpkg/dpkg.cfg.d/unsafe-io" # a root that is thrown away needs no disk that keeps up
  # The way to the package archives, and only that, is this machine's.
  cp -L /etc/resolv.conf "$1/etc/resolv.conf" 2>/dev/null || true
  cp /etc/apt/apt.conf.d/*prox* /etc/apt/apt.conf "$1/etc/apt/apt.conf.d/" 2>/dev/null || true
  cp -L /etc/ssl/certs/ca-certificates.crt "$1/etc/ssl/certs/" 2>/dev/null && echo "cafile=/etc/ssl/certs/ca-certificates.crt" >"$1/root/.npmrc" || true
}
# Runs a command in a root, with a bare environment.
inside() { # DIR COMMAND…
  in=$1 && shift
  unshare --mount --pid --fork --kill-child --propagation private sh -c '
    mount -t proc proc "$0/proc" && mount --bind /dev "$0/dev" && mount -t tmpfs tmpfs "$0/tmp" && exec chroot "$0" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin \
      HOME=/root DEBIAN_FRONTEND=noninteractive SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" "$@"' "$in" "$@"
}

make_all() { # OUT PLACE: all parts of a clean clone that stands at PLACE, in the root where there is one
  rm -rf "$1" && mkdir -p "$1"
  clone=$bareroot$2
  rm -rf "$clone" && mkdir -p "$(dirname "$clone")"
  git clone -q --no-hardlinks "$root" "$clone"
  git -C "$clone" checkout -q --detach "$commit"
  case " $parts " in *" source "*) git -C "$clone" archive --format=tar --prefix="spoolflow-$version/" HEAD | gzip -9n >"$1/spoolflow-$version.tar.gz" ;; esac
  if [ -z "$(echo "$built" | tr -d ' ')" ]; then return; fi
  if [ "$bareroot" ]; then
    inside "$bareroot" "$2/ci/release_parts.sh" "$2.made" $built || fail "the parts were not made: see the logs in $clone"
  else
    env -i PATH=/usr/local/bin:/usr/bin:/bin HOME="$HOME" SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" "$2/ci/release_parts.sh" "$2.made" $built
  fi
  cp "$clone.made"/* "$1"
}

bareroot=
if [ "$(echo "$built" | tr -d ' ')" ] && [ "$(id -u)" = 0 ] && command -v debootstrap >/dev/null; then
  bareroot=$work/root
  bare "$bareroot"
  one=/srv/one two=/srv/another/place/two
else
  [ -z "$(echo "$built" | tr -d ' ')" ] || echo "ci/release.sh: not root, or no debootstrap: with this machine's packages" >&2
  one=$work/one two=$work/another/place/two
fi
make_all "$out" "$one"
(cd "$out" && LC_ALL=C sha256sum -- * >../sums && mv ../sums SHA256SUMS)
if [ "$twice" ]; then
  make_all "$work/again" "$two"
  (cd "$work/again" && LC_ALL=C sha256sum -- * >../sums && mv ../sums SHA256SUMS)
  /usr/bin/python3 "$root/ci/same_files.py" "$out" "$work/again" || fail "the second time differs"
fi
case " $parts " in *" core "*)
  if [ "$bareroot" ]; then
    fresh=$work/fresh
    bare "$fresh"
    mkdir -p "$fresh/srv/packages" "$fresh/srv/source" && cp "$out"/*_amd64.deb "$fresh/srv/packages"
    git -C "$root" archive "$commit" docs examples tests/docs | tar -C "$fresh/srv/source" -xf -
    inside "$fresh" sh -euc 'apt-get -qq update && apt-get -qq install -y --no-install-recommends python3 /srv/packages/*.deb >/dev/null; spoolflow --version
      for walk in $(echo "$1" | tr "," " "); do
        [ "$walk" = none ] || { echo "walk $walk"; /srv/source/tests/docs/walk.sh "/srv/source/docs/walks/$walk.md" /usr/bin/spoolflow /srv/source/examples >/tmp/log 2>&1 || { tail -30 /tmp/log; exit 1; }; }
      done' sh "$walks" || fail "the packages do not do what the walks say"
  fi ;;
esac
ls -l "$out"
