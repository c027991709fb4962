"""What shows a model on a screen: the browser viewer, the notebook widget, the PyVista device."""
