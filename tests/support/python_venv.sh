# python_venv FOLDER REQUIREMENTS [pip options]: $venv, a virtual environment of python with these packages of
# PyPI, made once and again when they change. Calls `skip WHY`, which the caller has, where it cannot be made.
python_venv() {
  venv=$1
  local requirements=$2 python first
  shift 2
  ! cmp -s "$requirements" "$venv/installed.txt" || return 0
  python=$(command -v /usr/bin/python3 || command -v python3) || skip "there is no python3; run ./setup"
  echo "installing $requirements into $venv"
  rm -rf "$venv"
  "$python" -m venv "$venv" || skip "python3 makes no virtual environment; run ./setup (python3-venv)"
  if ! "$venv/bin/pip" --disable-pip-version-check install --quiet "$@" --requirement "$requirements"; then
    first=$(grep -oE -m 1 '^[A-Za-z0-9_-]+' "$requirements")
    "$venv/bin/pip" --disable-pip-version-check index versions "$first" >/dev/null 2>&1 || skip "PyPI cannot be reached"
    [[ $* != *--only-binary* ]] || skip "PyPI has nothing built for $("$python" --version) on $(uname -m): $requirements"
    echo "PyPI answers, but does not have what $requirements asks for, for $("$python" --version)" >&2
    exit 1
  fi
  cp "$requirements" "$venv/installed.txt"
}
