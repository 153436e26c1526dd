"""Engines for studies of sprung: thin adapters around `sprung study` (docs/studies.md)."""
