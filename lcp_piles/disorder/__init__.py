"""Disorder: random exact initial gaps of a scene, and its forces for many of them, proved."""
