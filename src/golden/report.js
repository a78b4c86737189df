'use strict';

for (const pair of document.querySelectorAll('.pair')) {
    const input = pair.querySelector('input');
    const move = () => pair.style.setProperty('--cut', input.value + '%');
    input.addEventListener('input', move);
    pair.closest('figure').querySelector('button').addEventListener('click', () => {
        input.value = Number(input.value) >= 50 ? 0 : 100;
        move();
    });
}

document.getElementById('zoom').addEventListener('change', event => {
    const style = document.documentElement.style, zoom = event.target.value;
    if (zoom === 'fit')
        style.removeProperty('--zoom');
    else
        style.setProperty('--zoom', zoom);
});

document.getElementById('only').addEventListener('change', event =>
    document.body.classList.toggle('only', event.target.checked));
