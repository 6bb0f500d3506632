"""Every test works in a folder of its own; they share a store, and leave the user's alone."""

import os

import pytest


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(autouse=True, scope="session")
def store(tmp_path_factory):
    os.environ["BAGNOLD_STORE"] = str(tmp_path_factory.mktemp("store"))
    yield
    del os.environ["BAGNOLD_STORE"]
