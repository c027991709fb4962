/* For whoever writes the book: the page comes anew when it was saved, and says what is wrong. */
(() => {
  const { news, version } = document.currentScript.dataset;
  let box = null;
  const stream = new EventSource(news);
  stream.onmessage = ({ data }) => {
    const told = JSON.parse(data);
    if (String(told.version) !== version) {
      stream.close();
      location.reload();
      return;
    }
    if (!told.complaints.length) {
      box?.remove();
      box = null;
      return;
    }
    if (!box) {
      box = document.createElement("aside");
      box.className = "book-news";
      box.setAttribute("role", "alert");
      document.body.append(box);
    }
    const title = document.createElement("strong");
    title.textContent = "The book as it was built last:";
    const text = document.createElement("pre");
    text.tabIndex = 0;
    text.textContent = told.complaints.join("\n");
    const close = document.createElement("button");
    close.type = "button";
    close.textContent = "Hide";
    close.onclick = () => box.remove();
    box.replaceChildren(title, close, text);
  };
})();
