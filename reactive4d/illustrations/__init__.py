"""Illustrations: models whose parameters a reader drives, and what devices have to know of whatever they show."""

from reactive4d.illustrations.bookmarks import Bookmark
from reactive4d.illustrations.controls import Control
from reactive4d.illustrations.illustration import Illustration
from reactive4d.illustrations.pages import Figure, Page
from reactive4d.illustrations.subjects import Subject, subject

__all__ = ["Bookmark", "Control", "Figure", "Illustration", "Page", "Subject", "subject"]
