"""Books: pages with figures that live, from a folder of Markdown: begun, built into a site, printed, served."""
