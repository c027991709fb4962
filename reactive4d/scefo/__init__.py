"""SCEFO, the script language: a scene as a text that people write, read and edit."""
