"""Scenes of the thesis' section 5.1: hyperelastic bodies."""

SCENES = {}
