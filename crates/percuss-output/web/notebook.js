"use strict";

// The scene in a frame of its own within a notebook: its colours are those of the system, its size that of the frame.

async function openNotebook() {
  const index = JSON.parse(document.getElementById("percuss-index").textContent);
  const columns = await unpack(index, document.getElementById("percuss-data").textContent);
  const [{ scene, frames }] = index.scenes;
  const unpacked = Object.fromEntries(Object.entries(frames).map(([key, k]) => [key, columns[k]]));
  const player = new Player(document.getElementById("scene"), new Motion(scene, unpacked));
  player.allInView = true; // the frame is as high as it is
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const theme = () => {
    document.documentElement.dataset.theme = dark.matches ? "dark" : "light";
    player.theme();
  };
  dark.addEventListener("change", theme);
  theme();
  const story = document.querySelector(".story");
  if (story.scrollHeight > story.clientHeight) story.tabIndex = 0; // what is cut can be scrolled with the keyboard
  player.seek(player.time);
  addEventListener("resize", () => player.draw());
}

if (typeof document !== "undefined") {
  openNotebook().catch((error) => {
    const fault = document.getElementById("fault");
    fault.hidden = false;
    fault.textContent = error.message;
    console.error(error);
  });
}
