#!/usr/bin/env bash
# cmake --install into a folder of its own: the program runs from there, and what belongs to it lies beside it.
# Usage: install_test.sh BUILD_FOLDER
set -euo pipefail

build="$1"
folder="$(mktemp -d)"
trap 'rm -rf -- "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

cmake --install "$build" --prefix "$folder/usr" >"$folder/log" || fail "cmake --install"
cd "$folder"
doc=usr/share/doc/trace-ray
[[ -f "$doc/LICENSE" && -f "$doc/README.md" ]] || fail "no licence or README in $doc"
[[ -f "$doc"/docs/ray-format.md ]] || fail "no pages"
# The links of the installed pages lead to installed files. Indented blocks are code.
while IFS= read -r page; do
  while IFS= read -r target; do
    [[ "$target" == *:* || "$target" == '#'* ]] && continue
    [[ -e "$(dirname "$page")/${target%%#*}" ]] || fail "$page: the link $target leads nowhere"
  done < <(awk '/^```/ { fenced = !fenced } !fenced && !/^    /' "$page" | grep -oE '\]\([^)]+\)' | sed 's/^](//; s/)$//')
done < <(find "$doc" -name '*.md')
for name in ray trace-ray; do
  "usr/bin/$name" --version | grep -q '^Trace ' || fail "the installed program does not run as $name"
done
usr/bin/ray "$doc/scenes/glass.ray" -w 16 picture.png -q || fail "it does not render the installed scene"
[[ -s picture.png ]] || fail "no picture"

# What shells, man and desktops want; tests of cli look at what stands in the pages and completions.
for file in man/man1/ray.1 man/man1/trace-ray.1 bash-completion/completions/{ray,trace-ray} \
            zsh/site-functions/_trace-ray fish/vendor_completions.d/{ray,trace-ray}.fish mime/packages/trace-ray.xml \
            icons/hicolor/{scalable/apps/trace-ray.svg,48x48/apps/trace-ray.png,128x128/apps/trace-ray.png}; do
  [[ -s "usr/share/$file" ]] || fail "no share/$file"
done
for kind in --man '--completion bash' '--completion zsh' '--completion fish'; do
  usr/bin/ray features $kind >said
  cmp -s said usr/share/man/man1/ray.1 || cmp -s said usr/share/bash-completion/completions/ray ||
    cmp -s said usr/share/zsh/site-functions/_trace-ray || cmp -s said usr/share/fish/vendor_completions.d/ray.fish ||
    fail "what is installed is not what ray features $kind prints"
done
if [[ -x "$build/bin/ray-studio" ]]; then
  usr/bin/ray-studio --version | grep -q '^Trace ' || fail "the studio was built and does not run installed"
  { usr/bin/ray gui a b 2>&1 || true; } | grep -q 'at most one scene' || fail "ray gui"
  [[ -e usr/libexec/trace-ray/ray-studio ]] || fail "ray gui does not find the studio beside itself"
  for file in man/man1/ray-studio.1 bash-completion/completions/ray-studio applications/trace-ray-studio.desktop; do
    [[ -s "usr/share/$file" ]] || fail "no share/$file"
  done
fi
! find usr -name '*_test*' -o -name 'test_*' | grep . || fail "tests are installed"

# All goes again by the list that cmake leaves.
while IFS= read -r file || [[ -n "$file" ]]; do
  [[ "$file" == "$folder"/* ]] || fail "the manifest names $file, which is not ours"
  rm -- "$file"
done <"$build/install_manifest.txt"
left="$(find usr ! -type d)"
[[ -z "$left" ]] || fail "the manifest does not know $left"
